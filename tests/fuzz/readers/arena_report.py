"""The events that the agent writes about a student's messages and the controller reads."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import Twist
from hypothesis import strategies as st
from rclpy.serialization import serialize_message
from sensor_msgs.msg import BatteryState, Imu, JointState
from std_srvs.srv import Trigger
from trajectory_msgs.msg import JointTrajectory

from autograder.arena.arena_log import LARGEST_EVENT
from autograder.arena.bounded_reading import BoundedReading
from autograder.authoring.evidence import events as ev
from autograder.engine.arena_run import NotGraded, read_events
from fuzz import strategies as odd
from fuzz.arena.wild_messages import wild_message
from fuzz.fuzzer import Fuzzer
from humanoid_interfaces.action import NavigateToPose, PickAndPlace, WalkTo
from humanoid_interfaces.msg import RobotState
from humanoid_interfaces.srv import ComputeArmIK, GetBatteryStatus
from ros_runtime.record.event import Event

TOPICS = (Twist, BatteryState, JointState, Imu, JointTrajectory, RobotState)
ANSWERS = (GetBatteryStatus.Response, Trigger.Response, ComputeArmIK.Response)
FEEDBACK = tuple(action.Impl.FeedbackMessage for action in (WalkTo, NavigateToPose, PickAndPlace))


def written(events: Sequence[Event]) -> list[bytes]:
    """Return the lines that the arena's log writes of events."""
    with odd.recorded() as (log, lines):
        for event in events:
            log.append(event)
        log.finish()
        return lines().splitlines(keepends=True)


def require_readable(events: Sequence[Event]) -> None:
    """Require that the controller reads whatever the log writes, and that no line is longer than it may be."""
    lines = written(events)
    assert len(lines) >= len(events)
    assert all(len(line) <= LARGEST_EVENT for line in lines)
    assert len(read_events(b"".join(lines))) == len(lines)


def require_events_or_none(report: bytes) -> None:
    """Require that a report is parsed, or that the result is NotGraded."""
    try:
        read_events(report)
    except NotGraded as error:
        assert len(str(error)) < 5000, "a sentence is short"


def require_bounded_message(drawn: tuple[Any, bytes]) -> None:
    """Require that bytes become a message of their type, or a record of why not."""
    kind, data = drawn
    with odd.recorded() as (log, lines):
        message = BoundedReading(log).unpack("message", "topic", data, kind)
        assert message is None or isinstance(message, kind)
        if message is not None:
            content = getattr(message, "feedback", message)  # of an action's, that is what is recorded
            log.append(ev.MessageReceived(topic="topic", message=content))
        log.finish()
        assert lines(), "nothing gets lost without a record"
        read_events(lines())


def _wild(kinds: Sequence[Any]) -> st.SearchStrategy[Any]:
    return st.tuples(st.sampled_from(kinds), st.integers(0, 2**32 - 1)).map(
        lambda drawn: wild_message(drawn[0], random.Random(drawn[1]))
    )


def _answered(drawn: tuple[Any, str]) -> Event:
    return ev.ServiceAnswered(t=1.0, call=drawn[1], response=drawn[0])


def _bytes_of(kinds: Sequence[Any]) -> st.SearchStrategy[Any]:
    """Generate a type, and the bytes of a damaged message of it."""

    def of(drawn: tuple[Any, int]) -> st.SearchStrategy[Any]:
        kind, seed = drawn
        data = serialize_message(wild_message(kind, random.Random(seed)))
        return st.tuples(st.just(kind), odd.mutated([data, serialize_message(kind())]))

    return st.tuples(st.sampled_from(kinds), st.integers(0, 2**32 - 1)).flatmap(of)


_messages = st.one_of(
    st.tuples(odd.texts, _wild(TOPICS)).map(
        lambda drawn: ev.MessageReceived(t=1.0, topic=drawn[0], message=drawn[1])
    ),
    st.tuples(_wild(ANSWERS), odd.texts).map(_answered),
)
_feedback = st.one_of(
    st.tuples(odd.texts, _wild([WalkTo.Feedback, NavigateToPose.Feedback, PickAndPlace.Feedback])).map(
        lambda drawn: ev.FeedbackReceived(t=1.0, goal=drawn[0], feedback=drawn[1])
    ),
    st.tuples(odd.texts, st.integers(-128, 127), _wild([WalkTo.Result, NavigateToPose.Result])).map(
        lambda drawn: ev.ResultReceived(t=1.0, goal=drawn[0], status=drawn[1], result=drawn[2])
    ),
    st.tuples(odd.texts, st.integers(-128, 127)).map(
        lambda drawn: ev.StatusSeen(t=1.0, goal=drawn[0], status=drawn[1])
    ),
    st.tuples(odd.texts, st.lists(odd.texts, max_size=50)).map(
        lambda drawn: ev.CancelAnswered(t=1.0, cancel=drawn[0], return_code=0, canceling=drawn[1])
    ),
)
_samples = [
    json.loads(line)
    for line in written(
        [
            ev.NodeStarted(t=0.0),
            ev.NodeOutput(t=0.5, stream="stdout", text="ready"),
            ev.ServiceAnswered(t=1.0, call="once", response=GetBatteryStatus.Response()),
            ev.FeedbackReceived(t=2.0, goal="walk", feedback=WalkTo.Feedback()),
            ev.MessageReceived(t=3.0, topic="imu", message=Imu()),
            ev.JointsTruth(t=4.0, positions={"a": 1.0}, velocities={"a": 1.0}),
            ev.ScenarioEnded(t=5.0),
        ]
    )
]
_lines = st.one_of(odd.damaged_json(_samples).map(lambda value: json.dumps(value).encode()), odd.blobs)
_reports = st.lists(_lines, max_size=4).map(lambda lines: b"\n".join([*lines, b""]))

FUZZERS = (
    Fuzzer("topics-log", "topics", st.lists(_messages, min_size=1, max_size=3), require_readable),
    Fuzzer("topics-bytes", "topics", _bytes_of(TOPICS), require_bounded_message),
    Fuzzer("answers-bytes", "answers", _bytes_of(ANSWERS), require_bounded_message),
    Fuzzer("feedback-bytes", "feedback", _bytes_of(FEEDBACK), require_bounded_message),
    Fuzzer("feedback-log", "feedback", st.lists(_feedback, min_size=1, max_size=3), require_readable),
    Fuzzer("report-lines", "output", _reports, require_events_or_none),
)
