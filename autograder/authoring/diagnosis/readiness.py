"""The first requirements on any run: the student's node appeared, and kept running.

The engine requires before every check that the node appeared.
"""

from __future__ import annotations

import difflib
import re

from autograder.authoring.diagnosis.connections import OUTSIDE
from autograder.authoring.diagnosis.exit_diagnosis import (
    end_in_words,
    ended_by_itself,
    remedy_for_a_limit,
    remedy_for_the_end,
)
from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record
from autograder.authoring.failure import Failure

_IS_OF_PARAMETERS = re.compile(r"\w/(describe|get|set)_parameters(_atomically)?$")
MIN_SIMILARITY = 0.6  # of two names, for one to count as a misspelling of the other


def require_ready(run: Record) -> None:
    """Require that the endpoints the scenario uses were offered in time.

    Raises:
        Failure: they were not; it says what was offered instead.
    """
    absent = run.first(ev.NodeNotReady)
    if absent is None:
        require_started(run)
        if run.first(ev.NodeReady) is None:
            raise unseen(run, "the record does not say whether the node was ready")
        return
    names = _readable(absent.missing)
    require_within_limits(run)
    exited = run.first(ev.NodeExited)
    if exited:
        remedy = remedy_for_the_end(run, exited)
        raise Failure(
            expected=f"a node that offers {names} and keeps running",
            observed=f"the program ended {end_in_words(run, exited)}",
            help=remedy.help
            if exited.returncode
            else "main() returned, or was never called: the node must spin (rclpy.spin), and the file must call "
            "main() at its end.",
            at=exited.t,
            see=remedy.see,
        )
    help, see = _what_is_offered_instead(run, absent)
    raise Failure(
        expected=f"a node that offers {names} within {absent.waited:.0f} s",
        observed=f"it runs, but offers {', '.join(absent.offered) or 'nothing'}",
        help=help,
        at=absent.t,
        see=see,
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
            help=remedy_for_a_limit(killed).help,
            at=killed.t,
            see=remedy_for_a_limit(killed).see,
        )


def require_alive(run: Record, instead: str = "") -> None:
    """Require that the student's process did not end before Ctrl-C; `instead` comes first in its help."""
    require_within_limits(run)
    if exited := ended_by_itself(run):
        remedy = remedy_for_the_end(run, exited)
        raise Failure(
            expected="a node that keeps running",
            observed=f"the program ended {end_in_words(run, exited)}",
            help=f"{instead} {remedy.help}" if instead and exited.returncode else remedy.help,
            at=exited.t,
            see=remedy.see,
        )


def _readable(missing: list[str]) -> str:
    """Name an action once instead of by its five endpoints."""
    return ", ".join(dict.fromkeys(map(_base, missing)))


def _base(name: str) -> str:
    """Return the last part of a service's name, or of its action's."""
    return name.split("/_action/")[0].rsplit("/", 1)[-1]


def _what_is_offered_instead(run: Record, absent: ev.NodeNotReady) -> tuple[str, str]:
    """Return what to do, by the offered name most similar to the missing one, and its lesson ('': the check's)."""
    offered: dict[str, str] = {}  # by the full name, without an action's endpoints
    for text in absent.offered:
        name, _, type_name = text.partition(" ")
        offered[name.split("/_action/")[0]] = type_name.strip("[]")
    kind = "action" if any("/_action/" in name for name in absent.missing) else "service"
    wanted = _base(absent.missing[0]) if absent.missing else ""
    if not offered and (node := _node_without_parameters(absent.missing)):
        return (
            f"No node is called {node}: give that name to the node's constructor, super().__init__({node!r}).",
            "",
        )
    if not offered:
        return (
            f"Your node offers no {kind}: create the server in the node's constructor, and keep it in self. If you do "
            "so already, the constructor waits for something earlier, such as a first message: create the server "
            "first, and wait in callbacks.",
            "",
        )
    namesakes = [name for name in offered if _base(name) == wanted]
    if namesakes:
        return _misplaced(namesakes[0], offered[namesakes[0]], _namespace(run), kind, wanted)
    similar = difflib.get_close_matches(wanted, map(_base, offered), n=1, cutoff=MIN_SIMILARITY)
    if similar:
        return f"You offer {similar[0]}; the task requires exactly the name {wanted}.", ""
    return (
        f"You offer {', '.join(map(_base, offered))}, but not {wanted}: create it in the constructor, too, with the "
        "name that the task gives.",
        "",
    )


def _node_without_parameters(missing: list[str]) -> str:
    """Return the name of the node if nothing but its parameter services is missing, else ''."""
    nodes = {name.rsplit("/", 2)[-2] if _IS_OF_PARAMETERS.search(name) else "" for name in missing}
    return nodes.pop() if len(nodes) == 1 else ""


def _misplaced(name: str, type_name: str, namespace: str, kind: str, wanted: str) -> tuple[str, str]:
    """Return what to do about the right name in a wrong namespace, or with a wrong type."""
    if name == f"/{wanted}":
        return f"You offer {name}, outside the namespace: remove the slash.", OUTSIDE
    if namespace and name != f"{namespace}/{wanted}":
        return f"You offer {name}: use the name {wanted!r} alone, without '~' or a namespace.", OUTSIDE
    return f"You offer {wanted} as {type_name}: give the {kind} the type that the task names.", ""


def _namespace(run: Record) -> str:
    """Return the robot's namespace, '' if there is no robot."""
    peers = run.first(ev.RobotPeers)
    return next((topic.rsplit("/", 1)[0] for topic in peers.subscribers), "") if peers else ""
