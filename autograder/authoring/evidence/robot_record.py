"""A record with the simulator's ground truth of the robot."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from operator import attrgetter
from typing import Any, TypeVar

from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record

LONGEST_GAP = 0.5  # s from a requested time to the nearest sample of the robot; there are 50 samples a second


E = TypeVar("E", bound=ev.Event)
T = TypeVar("T")


class RobotRecord(Record):
    """A record with the states of the robot, and the scenario's commands to it."""

    @property
    def robot_ready(self) -> ev.RobotReady:
        """The event that says what this robot can do; that of the course's own robot if the record has none."""
        return self.first(ev.RobotReady) or ev.RobotReady(t=0.0)

    def robot_at(self, t: float) -> ev.RobotTruth:
        """Return the robot at time `t` (s): the last sample not later, or the first there is."""
        return self.robot_between(t, t)[-1]

    def robot_between(self, start: float, end: float) -> Sequence[ev.RobotTruth]:
        """Return the samples from `start` to `end` (s), both included; raise if the record does not cover that time."""
        return self._known(self.ground_truth, start, end, "the robot")

    def reported(self, kind: type[E], start: float, end: float, of: str) -> Sequence[E]:
        """Return the simulator's events of one kind, as `robot_between` does for samples; `of` names them in errors."""
        return self._known(self.all(kind), start, end, of)

    def commands(self, do: str) -> list[ev.RobotCommanded]:
        """Return the commands `do` of the scenario that the robot carried out, in order."""
        return [event for event in self.all(ev.RobotCommanded) if event.command.get("do") == do]

    def last_command(self, do: str, *, before: float = math.inf, **arguments: Any) -> ev.RobotCommanded:
        """Return the last command `do` of the scenario that the robot carried out before a time.

        Args:
            do: the command, as `robot_sim.ros.scenario_control` names it.
            before: s on the arena's clock.
            arguments: those of the command's arguments that must have these values.

        Raises:
            Failure: there was none, because of the submission.
            CannotBeJudged: there was none, for another reason.
        """
        for event in reversed(self.commands(do)):
            if event.t <= before and arguments.items() <= event.command.items():
                return event
        raise unseen(self, f"the robot did not receive the command {do}")

    def _known(self, samples: Sequence[E], start: float, end: float, of: str) -> Sequence[E]:
        if not samples or samples[0].t > start + LONGEST_GAP or samples[-1].t < end - LONGEST_GAP:
            raise unseen(self, f"the record has no state of {of} at {end:.1f} s")
        return between(samples, start, end)


def between(samples: Sequence[T], start: float, end: float) -> Sequence[T]:
    """Return the samples from `start` to `end` (s), or else the last one before; they must be in order of time."""
    time = attrgetter("t")
    first, last = bisect_left(samples, start, key=time), bisect_right(samples, end, key=time)
    return samples[first:last] or samples[max(0, last - 1) : max(1, last)]
