"""Requires a complete record of a run before every check: absence of evidence never passes.

A submission that sends more than is read fails, so that no flood of messages can push out evidence.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

from autograder.authoring.checks import Scenario
from autograder.authoring.diagnosis.missing import held_up
from autograder.authoring.diagnosis.root_cause import why_the_robot_was_held_up
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.simulation_lag import MAX_LAG, lateness

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
MAX_REPORT_GAP = 1.5  # s on the arena's clock, between two reports of the simulator
COMMAND_TIMEOUT = 1.5  # s on the arena's clock until a command of the scenario takes effect


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


def require_whole(run: Transcript, scenario: Scenario) -> None:
    """Require that the scenario ran to its end, and that the simulator kept running and executed every command.

    Raises:
        Failure: the record is incomplete because of the submission.
        CannotBeJudged: the record is incomplete for another reason.
    """
    if run.first(ev.ScenarioEnded) is None:
        raise held_up(run, f"the record breaks off at {run.end:.1f} s")
    if scenario.robot is not None:
        _require_simulated_time(run)
        _require_effects(run)
        if lateness(run) > MAX_LAG and why_the_robot_was_held_up(run):
            raise held_up(run, f"the robot fell {lateness(run):.1f} s behind its time")


def _require_simulated_time(run: Transcript) -> None:
    """Require that the simulator reported without a long gap from the node's readiness to the end."""
    ready = run.first(ev.NodeReady)
    ended = run.first(ev.ScenarioEnded)
    start, end = ready.t if ready else 0.0, ended.t if ended else run.end
    times = [start, *(robot.t for robot in run.ground_truth if start < robot.t < end), end]
    silence, since = max((later - earlier, earlier) for earlier, later in pairwise(times))
    if not run.ground_truth or silence > MAX_REPORT_GAP:
        raise held_up(run, f"the simulation stood still for {silence:.1f} s from {since:.1f} s on")


def _require_effects(run: Transcript) -> None:
    """Require that each command of the scenario took effect, and within COMMAND_TIMEOUT unless the machine was slow."""
    effects = run.all(ev.RobotCommanded)
    for sent in run.all(ev.CommandSent):
        effect = next((effect for effect in effects if effect.command == sent.command), None)
        what = f"the robot did not obey the grader's command {sent.command.get('do', '')} at {sent.t:.1f} s"
        if effect is None:
            raise held_up(run, what)
        effects.remove(effect)
        if effect.t - sent.t > COMMAND_TIMEOUT and why_the_robot_was_held_up(run):
            raise held_up(run, f"{what} until {effect.t:.1f} s")
