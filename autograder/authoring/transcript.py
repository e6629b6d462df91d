"""Everything that one arena recorded, on one time axis, with the questions that checks ask.

If something that a check asks for is missing, that is a failure with a reason (`Missing`). If the arena did not do its
part, there is no grade (`CannotBeJudged`).
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, TypeVar

from autograder.authoring import events as ev
from autograder.authoring.call import Call, Request
from autograder.authoring.goal import Cancel, Goal
from autograder.authoring.missing import Missing, unseen

E = TypeVar("E")
A = TypeVar("A", ev.GoalAnswered, ev.ResultReceived, ev.CancelAnswered, ev.ServiceAnswered)

LONGEST_GAP = 0.5  # s from a moment asked about to the nearest sample of the robot; there are 50 a second


@dataclass(frozen=True)
class Transcript:
    """The events of one arena, in order of time.

    Attributes:
        scenario: its name.
        params: the scenario's inputs.
        events: all events but the robot's samples.
        ground_truth: the simulator's state of the robot, at 50 Hz.
        scale: how much faster than real time the arena's clock ran.
    """

    scenario: str
    params: Mapping[str, Any]
    events: Sequence[Any]
    ground_truth: Sequence[ev.RobotTruth] = field(repr=False)
    scale: float = 1.0

    @classmethod
    def from_events(
        cls, scenario: str, params: Mapping[str, Any], events: Sequence[Any], scale: float = 1.0
    ) -> Transcript:
        """Put events in order of time, with the arena's start at 0 s."""
        ordered = sorted(events, key=lambda event: event.t)
        origin = ordered[0].t if ordered else 0.0
        shifted = [replace(event, t=event.t - origin) for event in ordered]
        ground_truth = [event for event in shifted if isinstance(event, ev.RobotTruth)]
        others = [event for event in shifted if not isinstance(event, ev.RobotTruth)]
        return cls(scenario, dict(params), others, ground_truth, scale)

    def all(self, kind: type[E]) -> list[E]:
        """Return every event of one type, in order."""
        return list(self._by_kind.get(kind, ()))

    def first(self, kind: type[E]) -> E | None:
        """Return the first event of one type, or None."""
        return next(iter(self.all(kind)), None)

    @cached_property
    def _by_kind(self) -> Mapping[type, list[Any]]:
        sorted_out: dict[type, list[Any]] = {}
        for event in self.events:
            sorted_out.setdefault(type(event), []).append(event)
        return sorted_out

    def mark(self, name: str) -> float:
        """Return the time (s) of a moment that the scenario named."""
        for mark in self.all(ev.Mark):
            if mark.name == name:
                return mark.t
        raise Missing(self, expected=f"a scenario that gets to “{name}”", never="it never got there")

    # -- actions ------------------------------------------------------------------------------------------------------

    def goal(self, name: str) -> Goal:
        """Return one goal, which must have been sent."""
        sent = next((event for event in self.all(ev.GoalSent) if event.goal == name), None)
        if sent is None:
            raise Missing(
                self,
                expected=f"a server that gets as far as the goal “{name}”",
                never=f"the goal “{name}” was never sent",
            )
        return Goal(
            name,
            sent,
            self._in_time(ev.GoalAnswered, "goal", name, of="goal"),
            [event for event in self.all(ev.FeedbackReceived) if event.goal == name],
            [event for event in self.all(ev.StatusSeen) if event.goal == name],
            [cancel for cancel in self.cancels if cancel.sent.goal == name],
            self._in_time(ev.ResultReceived, "goal", name, of="result"),
            self,
        )

    @cached_property
    def cancels(self) -> list[Cancel]:
        """Every cancel request, in order."""
        sent = {event.cancel: event for event in reversed(self.all(ev.CancelSent))}
        return [
            Cancel(event, self._in_time(ev.CancelAnswered, "cancel", name, of="cancel"), self)
            for name, event in reversed(sent.items())
        ]

    def cancels_of(self, goal: str) -> list[Cancel]:
        """Return the requests to cancel one goal ("": every goal); there must be at least one."""
        requests = [cancel for cancel in self.cancels if cancel.sent.goal == goal]
        if not requests:
            which = f"the goal “{goal}”" if goal else "every goal"
            raise Missing(
                self,
                expected=f"a server that gets as far as the request to cancel {which}",
                never=f"nobody asked to cancel {which}",
            )
        return requests

    # -- services -----------------------------------------------------------------------------------------------------

    @cached_property
    def calls(self) -> list[Call]:
        """Every service call, in order."""
        sent = {event.call: event for event in reversed(self.all(ev.ServiceCalled))}
        return [
            Call(name, event, self._in_time(ev.ServiceAnswered, "call", name, of="call"), self)
            for name, event in reversed(sent.items())
        ]

    def calls_to(self, service: str) -> list[Call]:
        """Return the calls of one service, in order."""
        return [call for call in self.calls if call.service == service]

    def call(self, name: str) -> Call:
        """Return the call that the scenario gave this name, which must have been made."""
        for call in self.calls:
            if call.name == name:
                return call
        raise Missing(
            self,
            expected=f"a server that gets as far as the request “{name}”",
            never=f"the request “{name}” was never sent",
        )

    def given_up(self, what: str, name: str) -> ev.Unanswered | None:
        """Return when the scenario stopped waiting for the answer to a call, goal, cancel or result, if it did."""
        return next(
            (event for event in self.all(ev.Unanswered) if (event.what, event.id) == (what, name)), None
        )

    # -- scripted services --------------------------------------------------------------------------------------------

    def requests(self, service: str) -> list[Request]:
        """Return the requests to a scripted service, on any of its servers, in order."""
        received = {event.request: event for event in reversed(self.all(ev.RequestReceived))}
        return [
            Request(event, self._one(ev.ReplySent, "request", name))
            for name, event in reversed(received.items())
            if event.service == service
        ]

    # -- the robot ----------------------------------------------------------------------------------------------------

    def robot_at(self, t: float) -> ev.RobotTruth:
        """Return the robot at time `t` (s): the last sample not later, or the first there is."""
        self._require_samples(t, t)
        return self.ground_truth[max(0, bisect_right(self._sample_times, t) - 1)]

    def robot_between(self, start: float, end: float) -> Sequence[ev.RobotTruth]:
        """Return the samples from `start` to `end` (s), both included; there must be some from end to end."""
        self._require_samples(start, end)
        times = self._sample_times
        return self.ground_truth[bisect_left(times, start) : bisect_right(times, end)] or [self.robot_at(end)]

    def told(self, do: str, *, before: float = math.inf, **arguments: Any) -> ev.RobotCommanded:
        """Return the last command `do` of the scenario that the robot carried out before a time.

        Args:
            do: the command, as `robot_sim.ros.scenario_control` names it.
            before: s on the arena's clock.
            arguments: those of the command's arguments that must have these values.

        Raises:
            Failure: there was none, because of the submission.
            CannotBeJudged: there was none, for another reason.
        """
        wanted = {"do": do, **arguments}
        for event in reversed(self.all(ev.RobotCommanded)):
            if event.t <= before and wanted.items() <= event.command.items():
                return event
        raise unseen(self, f"the robot did not get the command {do}")

    @cached_property
    def _sample_times(self) -> list[float]:
        return [sample.t for sample in self.ground_truth]

    def _require_samples(self, start: float, end: float) -> None:
        times = self._sample_times
        if not times or times[0] > start + LONGEST_GAP or times[-1] < end - LONGEST_GAP:
            raise unseen(self, f"nothing is known of the robot at {end:.1f} s")

    # -- the student's process ----------------------------------------------------------------------------------------

    def output(self, stream: str | None = None) -> str:
        """Return what the student's process printed, on one stream or both."""
        lines = [event.text for event in self.all(ev.NodeOutput) if stream in (None, event.stream)]
        return "\n".join(lines)

    @property
    def last_words(self) -> str:
        """The last line on stderr that is not blank, cut to a readable length."""
        lines = [line.strip() for line in self.output("stderr").splitlines() if line.strip()]
        return lines[-1][:300] if lines else ""

    @property
    def end(self) -> float:
        """The time (s) at which the scenario ended, or of the last event."""
        ended = self.first(ev.ScenarioEnded)
        if ended:
            return ended.t
        return self.events[-1].t if self.events else 0.0

    def _in_time(self, kind: type[A], key: str, value: str, *, of: str) -> A | None:
        """Return the answer to something, unless the scenario had stopped waiting for it."""
        given_up = self.given_up(of, value)
        answer = self._one(kind, key, value)
        return None if answer is None or (given_up and answer.t > given_up.t) else answer

    def _one(self, kind: type[E], key: str, value: str) -> E | None:
        return next((event for event in self.all(kind) if getattr(event, key) == value), None)
