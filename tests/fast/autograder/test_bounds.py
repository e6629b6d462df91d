"""The failures of a node that sends more than is read, and of a build that does not end."""

from __future__ import annotations

import json
from typing import Any

import pytest

from autograder.authoring.checks import Scenario
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged
from autograder.engine.completeness import require_bounded
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.srv import GetBatteryStatus
from records import failure_of
from ros_runtime.record.event import to_line

JUDGING = exercise_module("interfaces", "judging")
MAX_QUOTE, require_built, require_fields = JUDGING.MAX_QUOTE, JUDGING.require_built, JUDGING.require_fields


def run_with(*events: Any, **params: Any) -> Transcript:
    return Transcript.from_events("any", params, [ev.NodeStarted(t=0.0), *events])


def bounded(run: Transcript) -> None:
    require_bounded(run, Scenario("any"))


def feedback(goal: str, number: int) -> list[Any]:
    return [ev.FeedbackReceived(t=1.0, goal=goal, feedback={}) for _ in range(number)]


def test_a_run_of_which_everything_was_read_is_bounded() -> None:
    bounded(run_with(*feedback("walk", 5)))


def test_dropped_feedback_is_the_students_failure_with_all_numbers() -> None:
    dropped = ev.RecordDropped(t=9.0, what=ev.FeedbackReceived.kind, count=600, seconds=4.2)
    failure = failure_of(bounded, run_with(*feedback("walk", 50), dropped))
    assert failure.observed == "it sent 650 feedback messages in 4.2 s; only 50 were read"
    assert failure.at == 9.0


def test_an_answer_that_is_too_large_is_named_with_its_size() -> None:
    large = ev.TooLarge(t=3.0, what="answer", id="call 2", bytes=12 * 2**20, limit=64 * 2**10)
    failure = failure_of(bounded, run_with(large))
    assert failure.expected == "every answer to have at most 64 KiB"
    assert failure.observed == "one of 12.0 MiB (“call 2”); it was not read"


def refused(bytes: int, reason: str) -> ev.RobotRefused:
    return ev.RobotRefused(t=3.0, topic="/robot/cmd_vel", count=1, bytes=bytes, limit=64, reason=reason)


def test_one_message_too_large_for_the_robot_fails_even_without_a_delay() -> None:
    failure = failure_of(bounded, run_with(refused(52, "malformed"), refused(2**20, "more than 64 bytes")))
    assert failure.expected == "every message on /robot/cmd_vel to have at most 64 bytes"
    assert failure.observed == "one of 1.0 MiB; the robot did not read it"


def test_a_flood_of_small_messages_that_does_not_delay_the_robot_is_allowed() -> None:
    bounded(run_with(refused(52, "more than 200 messages a second")))


def test_a_flooded_graph_is_quoted_in_readable_length() -> None:
    reason = "there were 30,000 nodes" + "!" * 5000
    failure = failure_of(bounded, run_with(ev.GraphFlooded(t=1.0, nodes=30_000, reason=reason)))
    assert failure.observed.startswith("there were 30,000 nodes")
    assert len(failure.observed) == 300


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        (b'{"kind": "mark", "name": "here"}', "a time t"),
        (b'{"kind": "confession", "t": 1.0}', "no kind of event 'confession'"),
        (b'{"kind": "mark", "t": "now", "name": "here"}', "valid number"),
        (b'{"kind": "mark", "t": 1.0, "name": "here", "more": 1}', "more"),
        (
            b'{"kind": "mark", "t": 1.0, "name": {"ros_type": "os/msg/Path", "ros_fields": {}}}',
            "no message type",
        ),
        (
            b'{"kind": "mark", "t": 1.0, "name": {"ros_type": "std_msgs/msg/String", "ros_fields": {"data": 1}}}',
            "this is no std_msgs/msg/String",
        ),
        (b"[]", "an object"),
        (b"{", "Expecting"),
    ],
)
def test_a_line_that_is_no_event_is_refused_with_the_reason(line: bytes, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint):
        ev.parse_event(line)


def test_every_event_of_a_recorders_can_be_read_back() -> None:
    for event in (
        ev.RecordDropped(t=1.0, what=ev.FeedbackReceived.kind, count=1, seconds=0.1),
        ev.TooLarge(t=1.0, what="answer", id="", bytes=2, limit=1),
        ev.GraphFlooded(t=1.0, nodes=0, reason="none"),
        ev.CommandSent(t=1.0, command={"do": "push"}),
        ev.ServiceAnswered(t=1.0, call="once", response=GetBatteryStatus.Response(available=True)),
        ev.GoalSent(t=1.0, goal="walk", action="walk_to", request=WalkTo.Goal(max_velocity=0.5)),
    ):
        assert ev.parse_event(to_line(event)) == event


# -- a definition's build ---------------------------------------------------------------------------------------------


def built(*events: Any, **report: Any) -> Transcript:
    lines = json.dumps(report, indent=1).splitlines() if report else []
    output = [ev.NodeOutput(t=5.0, stream="stdout", text=line) for line in lines]
    return run_with(*output, *events, file="Go.action")


def usage(cpu: float) -> ev.NodeUsage:
    return ev.NodeUsage(t=9.0, cpu=cpu, wall=150.0, peak_memory_mib=100.0)


PROBLEM = {"file": "Go.action", "line": 3, "text": "int a", "wrong": "int is no type", "expected": "int32"}


def test_the_first_of_thousands_of_problems_is_quoted_and_the_rest_counted() -> None:
    run = built(built=False, problems=[PROBLEM] * 20, more=4293, log="")
    failure = failure_of(require_built, run)
    assert failure.observed == "line 3, “int a”: int is no type (and 4,312 more)"


def test_a_build_that_left_no_report_after_much_work_is_the_students_failure() -> None:
    failure = failure_of(require_built, built(usage(120.0)))
    assert failure.observed == "its build was stopped after 120 s of processor time"


def test_a_build_that_failed_after_much_work_is_the_students_failure_too() -> None:
    run = built(usage(120.0), built=False, problems=[], more=0, log="ninja: stopped")
    assert "120 s of processor time" in failure_of(require_built, run).observed


def test_a_build_with_too_much_memory_is_reported_as_such() -> None:
    killed = ev.NodeKilled(t=4.0, reason="it used 900 MiB of memory; 700 MiB are allowed")
    assert "900 MiB" in failure_of(require_built, built(killed, usage(5.0))).observed


def test_a_build_that_never_got_a_processor_is_nobodys_failure() -> None:
    with pytest.raises(CannotBeJudged, match="the build printed no report"):
        require_built(built(usage(3.0)))


def test_many_fields_are_quoted_in_a_readable_length() -> None:
    fields = {f"field_{number}": "float64" for number in range(100)}
    types = {"my_interfaces/action/Go": {"goal": {"fields": fields, "constants": {}}}}
    run = built(built=True, types=types)
    for wanted in ({"pose": "string"}, {"field_1": "float64"}):
        assert len(failure_of(require_fields, run, "goal", wanted).observed) < MAX_QUOTE + 50
