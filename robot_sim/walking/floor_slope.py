"""How the floor slopes, felt with the sole of the foot that stands."""

import math
from collections.abc import Sequence
from dataclasses import dataclass



@dataclass(frozen=True, slots=True)
class SlopeParameters:
    """How the slope of the floor is felt, and what is believed of it."""

    filter_time: float = 0.2  # s
    level: float = 0.0175  # m/m; less is level
    steepest: float = 0.09  # m/m; more is a foot on its edge


class FloorSlope:
    """A low-pass filter of the sole's tilt.

    A foot that rolls over its edge tilts too: what is too little for a slope counts as level, and what is too much as
    the steepest one.
    """

    def __init__(self, timestep: float, parameters: SlopeParameters | None = None) -> None:
        self._parameters = parameters or SlopeParameters()
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
