"""Crouching and standing up: the height of the pelvis that the whole-body controller holds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from robot_sim.walking.planar import clamp

if TYPE_CHECKING:
    from robot_sim.g1.walker import LearnedWalker
    from robot_sim.walking.walker import Walker


@dataclass(frozen=True, slots=True)
class HeightLimits:
    """How low the robot can crouch, and how fast it goes down and up."""

    lowest: float = 0.45  # m, pelvis above the floor; below this, the ankles reach their stops
    speed: float = 0.15  # m/s
    risen: float = 0.015  # m below the stance's height, down to which it may walk


class BodyHeight:
    """The controller of the pelvis' height, at most `stance` (m); before walking it raises a crouching robot.

    Attributes:
        rate: commanded velocity of the body, m/s, upwards.
    """

    def __init__(self, walker: Walker | LearnedWalker, stance: float, limits: HeightLimits) -> None:
        self._walker = walker
        self._limits = limits
        self._stance = stance
        self.rate = 0.0

    @property
    def is_risen(self) -> bool:
        """Whether the pelvis is high enough to walk."""
        return self._walker.height > self._stance - self._limits.risen

    @property
    def is_idle(self) -> bool:
        """Whether no motion is commanded, or the commanded motion has ended."""
        return not (self.rate < 0 or (self.rate > 0 and self._walker.height < self._stance))

    def move(self, rate: float) -> None:
        """Move up at `rate` (m/s; negative: down) until the next command, within the limits of height and speed.

        Raises:
            ValueError: the rate is not finite.
        """
        if not math.isfinite(rate):
            raise ValueError(f"the rate is {rate}; expected a finite number in m/s")
        self.rate = clamp(rate, -self._limits.speed, self._limits.speed)

    def rise(self) -> None:
        """Move up to the height of the stance."""
        self.move(self._limits.speed)

    def set(self, height: float) -> None:
        """Set the height reference (m) at once, without a motion."""
        self._walker.height = self._within_limits(height)

    def tick(self, dt: float) -> None:
        """Move the reference for the next `dt` (s); the body goes down only while both feet stand."""
        if self.rate > 0 or (self.rate < 0 and self._walker.stands):
            self.set(self._walker.height + self.rate * dt)

    def _within_limits(self, height: float) -> float:
        return clamp(height, self._limits.lowest, self._stance)
