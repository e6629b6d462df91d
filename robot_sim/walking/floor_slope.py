"""The slope of the floor, measured by the tilt of the stance foot's sole."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SlopeParameters:
    """How the measured slope is filtered and bounded."""

    filter_time: float = 0.2  # s
    level: float = 0.0175  # m/m; smaller slopes count as level
    steepest: float = 0.09  # m/m; a foot with a larger tilt stands on its edge


class FloorSlope:
    """A low-pass filter of the sole's tilt.

    A foot that rolls over its edge tilts too, so the estimate is bounded: small tilts count as level, large ones as the
    steepest slope.
    """

    def __init__(self, timestep: float) -> None:
        self._parameters = SlopeParameters()
        self._fresh = timestep / self._parameters.filter_time
        self._x = self._y = 0.0

    def update(self, sole: Sequence[float]) -> None:
        """Update the filter for one timestep with the rotation matrix (row by row) of the stance foot's sole."""
        normal_x, normal_y, normal_z = sole[2], sole[5], sole[8]
        self._x += self._fresh * (-normal_x / normal_z - self._x)
        self._y += self._fresh * (-normal_y / normal_z - self._y)

    def estimate(self) -> tuple[float, float]:
        """Return the rise of the floor per m along x and y of the world."""
        steepness = math.hypot(self._x, self._y)
        if steepness < self._parameters.level:
            return 0.0, 0.0
        share = min(1.0, self._parameters.steepest / steepness)
        return share * self._x, share * self._y
