"""How much faster than real time an arena's clock runs.

A walking robot takes most of a core at the usual scale. Without a robot, or with one that rests, an idle machine can go
faster. A retry never does, because only a retry costs points.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

from autograder.authoring.checks import Scenario
from ros_runtime.workarounds.scaled_clock.clock import library_path

USUAL = 5.0
FAST_SCALE = 10.0
SLOWER_SCALES = (5.0, 2.0, 1.0)  # to fall back to when the machine cannot keep up
BUSY_LOAD = 1.5  # runnable processes per core; two arenas alone do not reach it


def highest_scale() -> float:
    """Return the scale arenas run at unless told otherwise: 1 where the clock's library could not be built."""
    return USUAL if library_path() else 1.0


def scale_of(scenario: Scenario, wanted: float) -> float:
    """Return the scale to run a scenario at, which is 1 if nothing in it is timed."""
    return wanted if scenario.timed else 1.0


class ClockScale:
    """Chooses the clock scales of one grading; `asked`, if given, replaces the choice."""

    def __init__(self, asked: float | None = None) -> None:
        self._asked = asked
        self._was_late = False

    def first_scale(self, scenario: Scenario) -> float:
        """Return the scale of a scenario's first run."""
        if self._asked:
            return self._asked
        usual = highest_scale()
        may_be_fast = usual > 1 and scenario.is_light and not self._was_late
        return FAST_SCALE if may_be_fast and _load_per_core() < BUSY_LOAD else usual

    def retry_scale(self, before: float, too_fast: bool) -> float:
        """Return the scale to retry a scenario that ran at scale `before`; `too_fast`: take a lower one."""
        if too_fast:
            return next((slower for slower in SLOWER_SCALES if slower < before), 1.0)
        return before if self._asked else min(before, USUAL)

    def attempts(self, scale: float) -> Sequence[float]:
        """Return the scales to try in turn until a run is on time; the last one, scale 1, is tried twice."""
        return (scale, *(slower for slower in SLOWER_SCALES if slower < scale), 1.0)

    def was_late(self) -> None:
        """Note a late run: later first runs use at most the usual scale."""
        self._was_late = True


def _load_per_core() -> float:
    return os.getloadavg()[0] / (os.cpu_count() or 1)
