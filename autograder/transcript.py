"""Everything one arena saw, on one time axis, with the questions checks ask of it."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeVar

from autograder import events as ev

E = TypeVar("E")


@dataclass(frozen=True)
class CancelHistory:
    """One cancel request and its answer (None: never answered)."""

    sent: ev.CancelSent
    answer: ev.CancelAnswered | None


@dataclass(frozen=True)
class GoalHistory:
    """The life of one goal as its client saw it."""

    name: str
    sent: ev.GoalSent
    answer: ev.GoalAnswered | None
    feedback: Sequence[ev.FeedbackReceived]
    statuses: Sequence[ev.StatusSeen]
    cancels: Sequence[CancelHistory]
    result: ev.ResultReceived | None

    @property
    def accepted(self) -> bool:
        """Whether the server said yes."""
        return self.answer is not None and self.answer.accepted

    @property
    def status(self) -> int | None:
        """The final status (action_msgs/GoalStatus), None without a result."""
        return self.result.status if self.result else None


@dataclass(frozen=True)
class CallHistory:
    """One service call and its answer (None: never answered)."""

    name: str
    sent: ev.ServiceCalled
    answer: ev.ServiceAnswered | None

    @property
    def latency(self) -> float:
        """Seconds to the answer; infinite without one."""
        return self.answer.t - self.sent.t if self.answer else math.inf


@dataclass(frozen=True)
class RequestHistory:
    """One request of the student's client to a service the grader played, and the reply it got (None: none)."""

    received: ev.RequestReceived
    reply: ev.ReplySent | None


@dataclass(frozen=True)
class Transcript:
    """The events of one arena, in order of time; `params` are the scenario's inputs."""

    scenario: str
    params: Mapping[str, Any]
    events: Sequence[Any]
    truth: Sequence[ev.RobotTruth] = field(repr=False)
    scale: float = 1.0

    @classmethod
    def from_events(
        cls, scenario: str, params: Mapping[str, Any], events: Sequence[Any], scale: float = 1.0
    ) -> Transcript:
        """Put events in order of time, with the arena's start at 0 s."""
        ordered = sorted(events, key=lambda event: event.t)
        origin = ordered[0].t if ordered else 0.0
        shifted = [event.model_copy(update={"t": event.t - origin}) for event in ordered]
        truth = [event for event in shifted if isinstance(event, ev.RobotTruth)]
        others = [event for event in shifted if not isinstance(event, ev.RobotTruth)]
        return cls(scenario, dict(params), others, truth, scale)

    def all(self, kind: type[E]) -> list[E]:
        """Return every event of one type, in order."""
        return [event for event in self.events if isinstance(event, kind)]

    def first(self, kind: type[E]) -> E | None:
        """Return the first event of one type, or None."""
        return next(iter(self.all(kind)), None)

    def mark(self, name: str) -> float:
        """Return the time (s) of a moment the scenario named; KeyError if it never came."""
        for mark in self.all(ev.Mark):
            if mark.name == name:
                return mark.t
        raise KeyError(f"the scenario {self.scenario} never marked {name!r}")

    def goal(self, name: str) -> GoalHistory:
        """Return the life of one goal; KeyError names the goals there are."""
        sent = {event.goal: event for event in self.all(ev.GoalSent)}
        if name not in sent:
            raise KeyError(f"no goal {name!r} in {self.scenario}; there are {sorted(sent)}")
        return GoalHistory(
            name,
            sent[name],
            self._one(ev.GoalAnswered, "goal", name),
            [event for event in self.all(ev.FeedbackReceived) if event.goal == name],
            [event for event in self.all(ev.StatusSeen) if event.goal == name],
            [cancel for cancel in self.cancels if cancel.sent.goal == name],
            self._one(ev.ResultReceived, "goal", name),
        )

    @cached_property
    def cancels(self) -> list[CancelHistory]:
        """Every cancel request, in order."""
        return [
            CancelHistory(c, self._one(ev.CancelAnswered, "cancel", c.cancel))
            for c in self.all(ev.CancelSent)
        ]

    def cancel(self, name: str) -> CancelHistory:
        """Return one cancel request by its name."""
        return next(cancel for cancel in self.cancels if cancel.sent.cancel == name)

    @cached_property
    def calls(self) -> list[CallHistory]:
        """Every service call, in order."""
        return [
            CallHistory(c.call, c, self._one(ev.ServiceAnswered, "call", c.call))
            for c in self.all(ev.ServiceCalled)
        ]

    def call(self, name: str) -> CallHistory:
        """Return one service call by its name."""
        return next(call for call in self.calls if call.name == name)

    def requests(self, service: str) -> list[RequestHistory]:
        """Return the requests that a played service got, whichever of its servers, in order."""
        return [
            RequestHistory(received, self._one(ev.ReplySent, "request", received.request))
            for received in self.all(ev.RequestReceived)
            if received.service == service
        ]

    # -- the robot ----------------------------------------------------------------------------------------------------

    def robot_at(self, t: float) -> ev.RobotTruth:
        """Return the robot at time `t` (s): the last sample not later, or the first there is."""
        if not self.truth:
            raise LookupError(f"the simulator reported nothing in {self.scenario}")
        return self.truth[max(0, bisect_right(self._truth_times, t) - 1)]

    def robot_between(self, start: float, end: float) -> Sequence[ev.RobotTruth]:
        """Return the samples from `start` to `end` (s), both included."""
        times = self._truth_times
        return self.truth[bisect_left(times, start) : bisect_right(times, end)]

    @cached_property
    def _truth_times(self) -> list[float]:
        return [sample.t for sample in self.truth]

    # -- the student's process ----------------------------------------------------------------------------------------

    def output(self, stream: str | None = None) -> str:
        """Return what the student's process printed, on one stream or both."""
        lines = [event.text for event in self.all(ev.NodeOutput) if stream in (None, event.stream)]
        return "\n".join(lines)

    @property
    def end(self) -> float:
        """The time (s) of the last event."""
        return self.events[-1].t if self.events else 0.0

    def _one(self, kind: type[E], key: str, value: str) -> E | None:
        return next((event for event in self.all(kind) if getattr(event, key) == value), None)
