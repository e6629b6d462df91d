"""Limits of a transcript: what is recorded of a student's messages, and how dropped ones are reported."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from math import isnan, nan
from typing import Any

import pytest

pytest.importorskip("rclpy")

from sensor_msgs.msg import BatteryState, JointState
from std_msgs.msg import String, UInt8MultiArray

from autograder.arena import arena_log as arena_log_module
from autograder.arena.arena_log import MAX_LENGTH, MOST_OF, MOST_UNMATCHED, ArenaLog
from autograder.authoring.evidence import events as ev
from ros_runtime.recorded_client.conversation import UNKNOWN_GOAL


class Recording:
    """A log, and the events that it has written to its file."""

    def __init__(self, path: Any) -> None:
        self._path = path
        self._fd = os.open(path, os.O_CREAT | os.O_WRONLY)
        self.log = ArenaLog(self._fd)

    def events(self) -> list[Any]:
        return [ev.parse_event(line) for line in self._path.read_bytes().splitlines()]

    def of(self, kind: type) -> list[Any]:
        return [event for event in self.events() if isinstance(event, kind)]

    def feedback(self, goal: str, message: Any = None, of: str = "") -> None:
        if self.log.admits(ev.FeedbackReceived.kind, of or goal):
            self.log.append(ev.FeedbackReceived(goal=goal, feedback=message or String()))

    def close(self) -> None:
        os.close(self._fd)


@pytest.fixture
def recording(tmp_path: Any) -> Iterator[Recording]:
    recording = Recording(tmp_path / "events")
    yield recording
    recording.close()


def test_a_flood_of_feedback_for_nobodys_goals_pushes_out_no_other(recording: Recording) -> None:
    for _ in range(MOST_UNMATCHED + 600):
        recording.feedback("unknown 0000", of=UNKNOWN_GOAL)
    recording.feedback("walk")
    assert recording.of(ev.FeedbackReceived)[-1].goal == "walk"


def test_what_is_dropped_is_recorded_with_its_number_and_time(
    recording: Recording, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = iter(range(10**6))
    monkeypatch.setattr(arena_log_module.time, "monotonic", lambda: float(next(now)))
    for _ in range(MOST_OF[ev.FeedbackReceived.kind] + 600):
        recording.feedback("walk")
    recording.log.finish()
    (dropped,) = recording.of(ev.RecordDropped)
    assert (dropped.what, dropped.count) == (ev.FeedbackReceived.kind, 600)
    assert dropped.seconds > MOST_OF[ev.FeedbackReceived.kind]


def test_without_dropped_events_no_drop_is_recorded(recording: Recording) -> None:
    recording.feedback("walk")
    recording.log.finish()
    assert recording.of(ev.RecordDropped) == []


def test_all_recorded_events_together_stay_below_a_limit(
    recording: Recording, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(arena_log_module, "LARGEST_RECORD", 10_000)
    for number in range(100):
        recording.feedback(f"goal {number}", String(data="x" * 1000))
    recording.log.append(ev.Mark(name="the scenario's own events are kept"))
    recording.log.finish()
    kept = len(recording.of(ev.FeedbackReceived))
    assert 0 < kept < 12
    assert recording.of(ev.RecordDropped)[0].count == 100 - kept
    assert recording.of(ev.Mark)


def test_a_long_text_is_cut_and_ends_with_its_length(recording: Recording) -> None:
    recording.feedback("walk", String(data="x" * 1_234_567))
    (feedback,) = recording.of(ev.FeedbackReceived)
    assert feedback.feedback.data == "x" * MAX_LENGTH + "…[cut: 1,234,567 characters]"
    assert recording.of(ev.TooLarge)[0].bytes == 1_234_567


def test_a_long_list_is_recorded_as_empty_and_by_its_length(recording: Recording) -> None:
    recording.feedback("walk", UInt8MultiArray(data=bytes(60_000)))
    (feedback,) = recording.of(ev.FeedbackReceived)
    assert len(feedback.feedback.data) == 0
    assert recording.of(ev.TooLarge)[0].bytes == 60_000


def test_an_event_that_is_still_too_large_is_not_written(recording: Recording) -> None:
    recording.feedback("walk", JointState(name=["x" * MAX_LENGTH] * 200))
    (large,) = recording.events()
    assert (large.kind, large.what) == ("too_large", ev.FeedbackReceived.kind)


def test_a_lone_surrogate_does_not_break_the_report(recording: Recording) -> None:
    recording.log.append(ev.NodeOutput(stream="stdout", text="\ud83d naïve"))
    assert recording.of(ev.NodeOutput)[0].text == "? naïve"


def test_a_line_is_json_whatever_is_in_it(recording: Recording) -> None:
    message = BatteryState(serial_number='"}\n{', voltage=nan, cell_voltage=[1.5, nan])
    recording.feedback("walk", message)
    (line,) = recording._path.read_bytes().splitlines()
    assert json.loads(line)["kind"] == "feedback_received"
    (feedback,) = recording.of(ev.FeedbackReceived)
    assert feedback.feedback.serial_number == '"}\n{'
    assert isnan(feedback.feedback.voltage)
    assert feedback.feedback.cell_voltage[0] == 1.5
