"""The first requirements on any run: the student's node appeared, and kept running.

The engine asks before every check whether it appeared.
"""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.failure import Failure
from autograder.authoring.missing import unseen
from autograder.authoring.record import Record


def require_ready(run: Record) -> None:
    """Require that the endpoints the scenario uses were offered in time.

    Raises:
        Failure: they were not; it says what was offered instead.
    """
    absent = run.first(ev.NodeNotReady)
    if absent is None:
        require_started(run)
        if run.first(ev.NodeReady) is None:
            raise unseen(run, "nobody looked whether the node was there")
        return
    names = _readable(absent.missing)
    require_within_limits(run)
    exited = run.first(ev.NodeExited)
    if exited:
        reason = run.last_words
        raise Failure(
            expected=f"a node that offers {names} and keeps running",
            observed=f"the program ended with status {exited.returncode}" + (f": {reason}" if reason else ""),
            help="main() returned: the node must spin (rclpy.spin), and the file must call main() at its end."
            if exited.returncode == 0
            else "Read the end of the log; run the file by itself with `python` to see the whole error.",
            at=exited.t,
        )
    raise Failure(
        expected=f"a node that offers {names} within {absent.waited:.0f} s",
        observed=f"it runs, but offers {', '.join(absent.offered) or 'nothing'}",
        help="Compare name and type letter by letter. Use a relative name (no leading '/'), create the server in "
        "the node's constructor, and spin the node.",
        at=absent.t,
    )


def require_started(run: Record) -> None:
    """Require that the student's program was started, which is the arena's task."""
    if run.first(ev.NodeStarted) is None:
        raise unseen(run, "the student's program was never started")


def require_within_limits(run: Record) -> None:
    """Require that the student's processes were not ended for exceeding a limit."""
    killed = run.first(ev.NodeKilled)
    if killed:
        raise Failure(
            expected="a node that stays within its limits",
            observed=f"it was ended: {killed.reason}",
            help="Look for a list that grows without end, or for processes and threads started in a loop.",
            at=killed.t,
        )


def require_alive(run: Record) -> None:
    """Require that the student's process did not end while the scenario ran."""
    require_within_limits(run)
    exited = run.first(ev.NodeExited)
    if exited and run.first(ev.NodeSignalled) is None:
        raise Failure(
            expected="a node that keeps running",
            observed=f"the program ended with status {exited.returncode}: {run.last_words}",
            help="An exception in a callback ends rclpy.spin() and with it the node: find it in the log below.",
            at=exited.t,
        )


def _readable(missing: list[str]) -> str:
    """Name an action once instead of by its five endpoints."""
    names = dict.fromkeys(name.split("/_action/")[0].rsplit("/", 1)[-1] for name in missing)
    return ", ".join(names)
