"""Limits on what a student's processes send; a submission that exceeds them fails, as its record is incomplete.

The engine requires this before every check, so that no flood of messages can push out evidence and let a check pass.
"""

from __future__ import annotations

from collections.abc import Mapping

from autograder.authoring.checks import Scenario
from autograder.authoring.diagnosis.missing import held_up
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure

# Kinds of events in the words of a report.
PLURALS: Mapping[str, str] = {
    ev.FeedbackReceived.kind: "feedback messages",
    ev.StatusSeen.kind: "changes of a goal's status",
    "status message": "messages on an action's status topic",
    ev.RequestReceived.kind: "requests",
    ev.GoalReceived.kind: "goals",
    ev.CancelReceived.kind: "requests to cancel",
    ev.ResultRequested.kind: "requests for a result",
    ev.ServiceAnswered.kind: "answers",
    ev.MessageReceived.kind: "messages on a topic",
    ev.NodeOutput.kind: "lines of output",
    ev.TooLarge.kind: "messages that are too large",
    "unread": "messages that could not be read in time",
    "unreadable": "messages that cannot be read",
}

PRINTS = "Print once when something happens, not in every round of a loop or in every callback."
FLOODS = (
    "Look for a loop that publishes, calls or answers without waiting: give it a rate, or a timer, and end it with its "
    "goal."
)


def require_bounded(run: Transcript, scenario: Scenario) -> None:
    """Require that everything the student's processes sent was read.

    Raises:
        Failure: it was not; it says what was too much.
    """
    _require_no_flood_of_nodes(run)
    _require_nothing_too_large(run)
    _require_nothing_dropped(run, scenario)


def _require_no_flood_of_nodes(run: Transcript) -> None:
    flood = run.first(ev.GraphFlooded)
    if flood:
        raise Failure(
            expected="a few nodes, with names that ROS allows",
            observed=flood.reason[:300],
            help="Look for nodes that are created in a loop or in a callback: make each one once, when the program "
            "starts, and destroy it at the end.",
            at=flood.t,
        )


def _require_nothing_too_large(run: Transcript) -> None:
    large = run.first(ev.TooLarge)
    if large:
        of = f" (“{large.id[:60]}”)" if large.id else ""
        raise Failure(
            expected=f"every {large.what[:60]} to have at most {_size(large.limit)}",
            observed=f"one of {_size(large.bytes)}{of}; it was not read",
            help="Look for a list or a text that grows from call to call, and send only what the interface asks for.",
            at=large.t,
        )
    refused = next((refused for refused in run.all(ev.RobotRefused) if refused.bytes > refused.limit), None)
    if refused:  # even if it did not delay the robot, because the grade must not depend on the machine
        raise Failure(
            expected=f"every message on {refused.topic[:60]} to have at most {_size(refused.limit)}",
            observed=f"one of {_size(refused.bytes)}; the robot did not read it",
            help="Look for a list that grows from message to message, and publish on the robot's topics only what the "
            "task asks for.",
            at=refused.t,
        )


def _require_nothing_dropped(run: Transcript, scenario: Scenario) -> None:
    for dropped in run.all(ev.RecordDropped):
        if dropped.what == ev.NodeOutput.kind and scenario.student == "node":
            continue  # what a node prints is never judged
        if dropped.what not in PLURALS:
            raise held_up(run, f"{dropped.count} events of the kind {dropped.what[:60]} were not recorded")
        what = PLURALS[dropped.what]
        read = sum(event.kind == dropped.what for event in run.events)
        raise Failure(
            expected=f"a program that sends no more {what} than it needs",
            observed=f"it sent {read + dropped.count:,} {what} in {dropped.seconds:.1f} s; only {read:,} were read",
            help=PRINTS if dropped.what == ev.NodeOutput.kind else FLOODS,
            at=dropped.t,
        )


def _size(count: int) -> str:
    """Return a number of bytes in a readable unit."""
    if count < 1024:
        return f"{count} bytes"
    return f"{count / 1024:.0f} KiB" if count < 2**20 else f"{count / 2**20:.1f} MiB"
