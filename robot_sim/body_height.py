"""Crouching and standing up: the height of the pelvis that the whole-body controller holds."""

import math

from robot_sim.parameters import Dimensions, HeightLimits
from robot_sim.planar import clamp
from robot_sim.walker import Walker


class BodyHeight:
    """Lowers and raises a standing robot; a robot that is to walk is raised first.

    Attributes:
        rate: m/s, upwards, that the body is asked to move at.
    """

    def __init__(self, walker: Walker, size: Dimensions, limits: HeightLimits) -> None:
        self._walker = walker
        self._limits = limits
        self._stance = size.stance_height
        self.rate = 0.0

    @property
    def is_risen(self) -> bool:
        """High enough to walk."""
        return self._walker.height > self._stance - self._limits.risen

    def move(self, rate: float) -> None:
        """Go up at ``rate`` (m/s; negative: down) until told otherwise, within the limits of height and speed.

        Raises:
            ValueError: the rate is not finite.
        """
        if not math.isfinite(rate):
            raise ValueError(f"the rate is {rate}; expected a finite number in m/s")
        self.rate = clamp(rate, -self._limits.speed, self._limits.speed)

    def rise(self) -> None:
        """Go up to the height of the stance."""
        self.rate = self._limits.speed

    def set(self, height: float) -> None:
        """Take a height (m) at once, as a robot that is put there does."""
        self._walker.height = clamp(height, self._limits.lowest, self._stance)

    def tick(self, dt: float) -> None:
        """Move the reference for the next ``dt`` (s); the body goes down only while both feet stand."""
        if self.rate > 0 or (self.rate < 0 and self._walker.stands):
            self.set(self._walker.height + self.rate * dt)
