"""Records the robot's topics, and the times of the notebook's calls, goals and cancels."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from IPython.display import HTML

from lab.client import topics
from lab.client.interaction_log import log
from lab.client.messages import label_of
from lab.client.waiting import becomes_true
from lab.errors import LabError
from lab.pictures.film import film_of_messages
from lab.pictures.labels import Mark
from lab.pictures.quantities import quantity_named
from lab.pictures.recorded_goal import RecordedGoal, last_goal
from lab.pictures.time_plot import Area, Curve, draw_panels
from ros_runtime.message_constants import RobotMode, name_of
from ros_runtime.record.event import Event

LAST_MESSAGES_TIMEOUT = 1.0  # s after the end of the block; odom is published at 20 Hz


@contextmanager
def record_robot() -> Iterator[Recording]:
    """Record the robot's topics and the notebook's calls, goals and cancels during the `with` block.

        with lab.record_robot() as recording:
            ...
        recording.plot("speed", "height")

    Raises NoRobotError when no robot is running.
    """
    before = {topic: topics.latest(topic) for topic in topics.TOPICS}
    recording = Recording(topics.robot())
    for topic, message in before.items():
        recording.add_message(topic, message)
    with topics.listening(recording.add_message):
        with log.listening(recording.add_event):
            try:
                yield recording
            finally:
                recording.end()
        becomes_true(recording.has_all_messages, LAST_MESSAGES_TIMEOUT)


class Recording:
    """The robot's messages and the notebook's requests and answers. All times are in s since the recording began.

    A message has the time of its stamp. A request or answer has the time at which the notebook sent or received it.
    Both use this machine's clock.

    Attributes:
        robot: the name of the robot that was recorded.
    """

    def __init__(self, robot: str = "humanoid") -> None:
        self.robot = robot
        self._start = time.monotonic()
        self._start_of_stamps = time.time()
        self._seconds: float | None = None
        self._messages: defaultdict[str, list[tuple[float, Any]]] = defaultdict(list)
        self._marks: list[Mark] = []
        self._own_marks: list[Mark] = []
        self._events: list[Event] = []

    @property
    def seconds(self) -> float:
        """The duration of the recording in s; while it still records, its duration so far."""
        return time.monotonic() - self._start if self._seconds is None else self._seconds

    def mark(self, label: str) -> None:
        """Add a label at the current time; plots show it."""
        self._own_marks.append(Mark(self.seconds, label))

    @property
    def marks(self) -> list[Mark]:
        """The labels that `mark()` has added."""
        return list(self._own_marks)

    @property
    def _all_marks(self) -> list[Mark]:
        """The labels of requests and answers, and those that `mark()` has added."""
        return [*self._marks, *self._own_marks]

    def time_of(self, label: str) -> float:
        """Return the time of the first event with this label, in s since the beginning.

            recording.time_of("result: CANCELED") - recording.time_of("cancel requested")

        `label` is the text in a plot. The name of a mode, such as "STANDING", is the first change to that mode.

        Raises LabError when there is no such label; the message lists the labels.
        """
        moments = sorted([*self._all_marks, *self._mode_changes()])
        for mark in moments:
            if mark.label == label or mark.label.endswith(f"→ {label}"):
                return mark.time
        seen = "; ".join(f'"{mark.label}" at {mark.time:.2f} s' for mark in moments) or "none"
        raise LabError(
            f'"{label}" did not happen while the robot was recorded; the recorded events are: {seen}'
        )

    def values(self, quantity: str) -> tuple[np.ndarray, np.ndarray]:
        """Return the times of a quantity, in s since the beginning, and its values.

        The quantities are "speed" and "sideways speed" (m/s, forwards and to the left, in base_link), "turn rate"
        (rad/s, left is positive), "x" and "y" (m, of the pelvis in frame odom), "height" (m, of the pelvis above the
        floor), "heading" (rad, in frame odom), "pitch" (rad, of the pelvis, forwards is positive), "tilt" (rad, of the
        pelvis from upright) and "power" (W, drawn from the battery). The scene "table" also has "grip" (N, of the
        fingers of the right hand) and "cup height" (m, of its centre above the floor). A joint's name, such as
        "l_elbow", stands for its position (rad; m for a finger).

        Raises LabError when there is no such quantity, or when no value of it was recorded.
        """
        wanted = quantity_named(quantity)
        pairs = [
            (at, wanted.read(message))
            for at, message in self._messages[wanted.topic]
            if 0.0 <= at <= self.seconds
        ]
        if not pairs:
            raise LabError(
                f"no {quantity} was recorded: the block lasted {self.seconds:.2f} s, and no message on "
                f"{wanted.topic} arrived in that time; record for longer, and check that the robot runs"
            )
        times, values = np.array(pairs).T
        return times, np.unwrap(values) if wanted.is_angle else values

    def messages(self, topic: str) -> list[tuple[float, Any]]:
        """Return the messages of one of the robot's topics with their times, in s since the beginning."""
        return list(self._messages[topic])

    def mean(self, quantity: str) -> float:
        """Return the mean of a quantity, in its unit; `values` lists the quantities.

        Raises LabError when there is no such quantity, or when no value of it was recorded.
        """
        return float(self.values(quantity)[1].mean())

    def plot(
        self,
        *quantities: str,
        title: str = "What the robot did",
        compare: Mapping[str, Callable[[float], float]] | None = None,
        between: Mapping[str, tuple[str, str]] | None = None,
    ) -> HTML:
        """Draw quantities over time, each in a panel of its own, with the notebook's requests and the robot's modes.

        Args:
            quantities: their names; `values` lists them.
            title: the title of the picture.
            compare: curves to draw dashed in the first panel, by name: a function of the time in s.
            between: periods to colour, by name: the labels of the events at which the period begins and ends.

        Raises LabError when there is no such quantity or label, or when no value of a quantity was recorded.
        """
        if not quantities:
            raise LabError('name the quantities to plot, for example recording.plot("speed", "height")')
        kinds = [quantity_named(name) for name in quantities]
        curves = [
            Curve(name, kind.unit, kind.min_range, *self.values(name))
            for name, kind in zip(quantities, kinds, strict=True)
        ]
        return draw_panels(
            curves,
            seconds=self.seconds,
            marks=self._all_marks,
            changes=self._mode_changes(),
            compare=compare or {},
            areas=[
                Area(name, self.time_of(begin), self.time_of(end))
                for name, (begin, end) in (between or {}).items()
            ],
            title=title,
        )

    def film(
        self, file: str | Path | None = None, *, camera: str = "track", slow_motion: float = 1.0
    ) -> HTML:
        """Make a film from the recorded messages; also write it to `file`, a .webp.

        `camera` is "track", "side" or "front". With `slow_motion` 4 the film lasts four times as long. Without OpenGL
        you get the caption of the film and the reason why there is none.

        Raises:
            LabError: nothing was recorded.
            ValueError: the film would last longer than 60 s, or there is no such camera.
        """
        self.values("height")  # raises an error if no message was recorded
        return film_of_messages(
            self._messages["odom"],
            self._messages["joint_states"],
            {name: self._messages[topics.topic_of(name)] for name in topics.object_poses()},
            self.seconds,
            marks=sorted(self._all_marks),
            robot=self.robot,
            slow_motion=slow_motion,
            camera=camera,
            file=file,
        )

    def add_message(self, topic: str, message: Any) -> None:
        """Add a message of one of the robot's topics."""
        stamp = message.header.stamp
        self._messages[topic].append((stamp.sec + stamp.nanosec * 1e-9 - self._start_of_stamps, message))

    def add_event(self, event: Event) -> None:
        """Add an event of the notebook; plots show a label for requests and answers."""
        self._events.append(event)
        label = label_of(event)
        if label is not None:
            self._marks.append(Mark(event.t - self._start, label))

    def end(self) -> None:
        """End the recording at the current time; messages with a later stamp are not part of it."""
        self._seconds = self.seconds

    def has_all_messages(self) -> bool:
        """Whether a message with a stamp after the end has arrived, which means that all earlier ones have arrived."""
        return any(at > self.seconds for at, _ in self._messages["odom"][-1:])

    def goal(self) -> RecordedGoal:
        """Return the goal that was sent last; its times are in s since the recording began.

        Raises LabError when no goal was sent.
        """
        goal = last_goal(replace(event, t=event.t - self._start) for event in self._events)
        if goal is None:
            raise LabError("no goal was sent while the robot was recorded; send it inside the `with` block")
        return goal

    def _mode_changes(self) -> list[Mark]:
        states = [(at, state.mode) for at, state in self._messages["robot_state"] if at <= self.seconds]
        return [
            Mark(max(0.0, at), f"{name_of(RobotMode, before)} → {name_of(RobotMode, mode)}")
            for (_, before), (at, mode) in pairwise(states)
            if mode != before and at >= 0.0
        ]
