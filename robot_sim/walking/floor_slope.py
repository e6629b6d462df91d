"""The slope of the floor, measured by the tilt of the stance foot's sole."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SlopeParameters:
    """How the felt slope is filtered and bounded."""

    filter_time: float = 0.2  # s
    level: float = 0.0175  # m/m; less is level
    steepest: float = 0.09  # m/m; more is a foot on its edge


class FloorSlope:
    """A low-pass filter of the sole's tilt.

    A foot that rolls over its edge tilts too, so the estimate is bounded: small tilts count as level, large ones as the
    steepest slope.
    """

    def __init__(self, timestep: float) -> None:
        self._parameters = SlopeParameters()
        self._fresh = timestep / self._parameters.filter_time
        self._x = self._y = 0.0

    def feel(self, sole: Sequence[float]) -> None:
        """Take in the rotation matrix (row by row) of the sole that stands, for one timestep."""
        normal_x, normal_y, normal_z = sole[2], sole[5], sole[8]
        self._x += self._fresh * (-normal_x / normal_z - self._x)
        self._y += self._fresh * (-normal_y / normal_z - self._y)

    def estimate(self) -> tuple[float, float]:
        """Rise of the floor per m along x and y of the world."""
        steepness = math.hypot(self._x, self._y)
        if steepness < self._parameters.level:
            return 0.0, 0.0
        share = min(1.0, self._parameters.steepest / steepness)
        return share * self._x, share * self._y
