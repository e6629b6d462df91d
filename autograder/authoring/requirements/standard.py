"""Checks for every server. Each takes one line in an exercise's checks.

server_appears = standard.server_appears("get_battery_status", points=1, on=INTERRUPT)
ends_cleanly = standard.ends_cleanly(points=1, on=INTERRUPT, needs=server_appears)
"""

from __future__ import annotations

from collections.abc import Sequence

from autograder.authoring.checks import Check, Scenario, check_by
from autograder.authoring.diagnosis.exit_diagnosis import end_in_words, remedy_for_the_end
from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.diagnosis.readiness import require_ready, require_within_limits
from autograder.authoring.diagnosis.stack_location import where_it_waited
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure, expect
from autograder.authoring.obligation import check_of, obligation, whole_run

Needs = Check | Sequence[Check]
_CLEAN_END = (
    "Catch KeyboardInterrupt and ExternalShutdownException around spin(), destroy the node and call "
    "rclpy.try_shutdown() in a finally block."
)
_STILL_RUNS = "Something keeps the process alive, such as a thread that is not a daemon. "
# What the last line on stderr says about why a program did not end with status 0.
_REASONS = {
    "rcl_shutdown already called": "Ctrl-C has shut rclpy down already, so rclpy.shutdown() raises: call "
    "rclpy.try_shutdown() instead.",
    "KeyboardInterrupt": "Nothing catches the KeyboardInterrupt that Ctrl-C raises. " + _CLEAN_END,
    "ExternalShutdownException": "spin() reports Ctrl-C in two ways, as KeyboardInterrupt or as "
    "ExternalShutdownException: catch both.",
}


def server_appears(
    what: str,
    *,
    points: int = 1,
    on: Scenario,
    see: str = "02_services#first-file",
    clauses: Sequence[int] = (),
) -> Check:
    """Make the check that the node offers `what`; use the shortest scenario, because its verdict comes first."""
    title = f"The node offers {what}"
    return check_by(require_ready, title, points=points, on=on, see=see, clauses=clauses)


def ends_cleanly(
    *,
    points: int = 1,
    on: Scenario | Sequence[Scenario],
    needs: Needs,
    see: str = "02_services#conventions",
    clauses: Sequence[int] = (),
) -> Check:
    """Make the check that Ctrl-C, which each scenario presses, ends the node with exit status 0."""
    exits = obligation(*clauses, of=whole_run)(exits_with_status_0)
    return check_of(exits, points=points, on=on, needs=needs, see=see, to_its_end=False)


def exits_with_status_0(run: Transcript) -> str:
    """Ctrl-C ends the node with exit status 0.

    Output is not judged: rclpy prints tracebacks of its own if Ctrl-C interrupts one of its threads.
    """
    require_within_limits(run)
    signalled = run.first(ev.NodeSignalled)
    if signalled is None:
        raise unseen(run, "Ctrl-C was never pressed")
    exited = run.first(ev.NodeExited)
    if exited is None:
        place = where_it_waited(run, in_main=True)
        raise Failure(
            expected="the program to end after SIGINT (Ctrl-C)",
            observed=f"it was still running {run.end - signalled.t:.1f} s later",
            help=(f"It was blocked in {place}: let Ctrl-C end that call. " if place else _STILL_RUNS)
            + _CLEAN_END,
            at=signalled.t,
        )
    if exited.t < signalled.t:
        remedy = remedy_for_the_end(run, exited)
        raise Failure(
            expected="a node that runs until Ctrl-C",
            observed=f"Ctrl-C was not tested: the node had already ended {end_in_words(run, exited)}",
            help=remedy.help,
            at=exited.t,
            see=remedy.see,
        )
    last_words = run.last_words
    expect(
        exited.returncode == 0,
        expected="exit status 0 after SIGINT (Ctrl-C)",
        observed=f"exit status {exited.returncode}: {last_words or 'nothing on stderr'}",
        help=next((reason for sign, reason in _REASONS.items() if sign in last_words), _CLEAN_END),
        at=exited.t,
    )
    return "Ctrl-C"
