"""Detects when the robot stands so still that its physics need not be integrated."""

from __future__ import annotations

import mujoco
import numpy as np

# While the robot stands, a joint's motion decays within 0.26 s; from this speed it moves at most 0.5 µm or µrad.
REST_SPEED = 2e-6  # rad/s or m/s
REST_TIME = 0.1  # s


class Rest:
    """A detector of rest.

    Attributes:
        allowed: whether the robot may rest at all.
    """

    def __init__(self, data: mujoco.MjData, timestep: float) -> None:
        self.allowed = False
        self._velocity = data.qvel
        self._ticks_needed = round(REST_TIME / timestep)
        self._still_ticks = 0

    def wake(self) -> None:
        """Restart the detection after a command: physics is integrated until the robot stands still again."""
        self._still_ticks = 0

    @property
    def is_reached(self) -> bool:
        """Whether the body has stood still long enough and no command has come since."""
        return self._still_ticks >= self._ticks_needed

    def watch(self, is_idle: bool) -> None:
        """Check the speeds after one integrated timestep; `is_idle`: the robot stands without a command."""
        still = is_idle and np.abs(self._velocity).max() < REST_SPEED
        self._still_ticks = self._still_ticks + 1 if still else 0
