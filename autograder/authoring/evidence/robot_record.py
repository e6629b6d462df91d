"""The record with the simulator's word on what the robot did."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from functools import cached_property
from typing import Any

from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record

LONGEST_GAP = 0.5  # s from a moment asked about to the nearest sample of the robot; there are 50 a second


class RobotRecord(Record):
    """A record of which one may ask where the robot was and what it was told."""

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
