"""Everything that one arena recorded, on one time axis."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, TypeVar

from autograder.authoring.evidence import events as ev

E = TypeVar("E")
A = TypeVar("A", ev.GoalAnswered, ev.ResultReceived, ev.CancelAnswered, ev.ServiceAnswered)
R = TypeVar("R", bound="Record")
POSTURES = (ev.BodyDescribed, ev.PostureTruth)
# Lines of rclpy that do not explain an exit: on a task that it discards at the end, and log messages.
_OF_RCLPY = re.compile(r"The following exception was never retrieved|\[(DEBUG|INFO|WARN|ERROR|FATAL)\] \[")


@dataclass(frozen=True)
class Record:
    """The events of one arena, in order of time.

    Attributes:
        scenario: its name.
        params: the scenario's inputs.
        events: all events except the robot's samples.
        ground_truth: the simulator's state of the robot, at 50 Hz.
        scale: how much faster than real time the arena's clock ran.
        postures: of the whole robot, if a recording was requested; kept apart, so that no verdict depends on them.
    """

    scenario: str
    params: Mapping[str, Any]
    events: Sequence[Any]
    ground_truth: Sequence[ev.RobotTruth] = field(repr=False)
    scale: float = 1.0
    postures: Sequence[ev.BodyDescribed | ev.PostureTruth] = field(default=(), repr=False)

    @classmethod
    def from_events(
        cls: type[R], scenario: str, params: Mapping[str, Any], events: Sequence[Any], scale: float = 1.0
    ) -> R:
        """Put events in order of time, with the arena's start at 0 s."""
        ordered = sorted(events, key=lambda event: event.t)
        judged = [event for event in ordered if not isinstance(event, POSTURES)]
        origin = judged[0].t if judged else 0.0
        return cls(
            scenario,
            dict(params),
            [_shifted(event, origin) for event in judged if not isinstance(event, ev.RobotTruth)],
            [_shifted(event, origin) for event in judged if isinstance(event, ev.RobotTruth)],
            scale,
            [_shifted(event, origin) for event in ordered if isinstance(event, POSTURES)],
        )

    def all(self, kind: type[E]) -> list[E]:
        """Return every event of one type, in order."""
        return list(self._by_kind.get(kind, ()))

    def first(self, kind: type[E]) -> E | None:
        """Return the first event of one type, or None."""
        return next(iter(self.all(kind)), None)

    def by_name(self, kind: type[E], key: str) -> dict[str, E]:
        """Return the first event of one type for each value of its field `key`, in order."""
        firsts: dict[str, E] = {}
        for event in self.all(kind):
            firsts.setdefault(getattr(event, key), event)
        return firsts

    @cached_property
    def _by_kind(self) -> Mapping[type, list[Any]]:
        sorted_out: dict[type, list[Any]] = {}
        for event in self.events:
            sorted_out.setdefault(type(event), []).append(event)
        return sorted_out

    # -- answers ------------------------------------------------------------------------------------------------------

    def given_up(self, what: str, name: str) -> ev.Unanswered | None:
        """Return the event of giving up the wait for the answer to a call, goal, cancel or result, if there is one."""
        return next((each for each in self.all(ev.Unanswered) if (each.what, each.id) == (what, name)), None)

    def in_time(self, kind: type[A], key: str, value: str, *, of: str) -> A | None:
        """Return the first answer whose field `key` has a value, unless the scenario had stopped waiting for it."""
        given_up = self.given_up(of, value)
        answer = self.one(kind, key, value)
        return None if answer is None or (given_up and answer.t > given_up.t) else answer

    def one(self, kind: type[E], key: str, value: str) -> E | None:
        """Return the first event of one type whose field `key` has a value, or None."""
        return next((event for event in self.all(kind) if getattr(event, key) == value), None)

    # -- the student's process ----------------------------------------------------------------------------------------

    def output(self, stream: str | None = None) -> str:
        """Return what the student's process printed, on one stream or both."""
        lines = [event.text for event in self.all(ev.NodeOutput) if stream in (None, event.stream)]
        return "\n".join(lines)

    @property
    def last_words(self) -> str:
        """The last line on stderr that is neither blank nor from rclpy, cut to a readable length."""
        lines = [line.strip() for line in self.output("stderr").splitlines() if line.strip()]
        said = [line for line in lines if not _OF_RCLPY.match(line)] or lines
        return said[-1][:300] if said else ""

    @property
    def end(self) -> float:
        """The time (s) at which the scenario ended, or of the last event."""
        ended = self.first(ev.ScenarioEnded)
        if ended:
            return ended.t
        return self.events[-1].t if self.events else 0.0


def _shifted(event: Any, origin: float) -> Any:
    return replace(event, t=event.t - origin)
