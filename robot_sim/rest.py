"""Detection of rest: integrating a robot that stands still would change nothing visible."""

from __future__ import annotations

import mujoco
import numpy as np

# Standing, the motion that is left dies away within 0.26 s, so 0.5 µm or µrad are still to come.
STILL = 2e-6  # rad/s or m/s
HOLD = 0.1  # s


class Rest:
    """A detector of rest.

    Attributes:
        allowed: whether the robot may rest at all.
    """

    def __init__(self, data: mujoco.MjData, timestep: float) -> None:
        self.allowed = False
        self._velocity = data.qvel
        self._ticks_needed = round(HOLD / timestep)
        self._still_ticks = 0

    def wake(self) -> None:
        """Note a command to the body: it is integrated until it stands still again."""
        self._still_ticks = 0

    @property
    def is_reached(self) -> bool:
        """Whether the body stood still long enough, and no command came since."""
        return self._still_ticks >= self._ticks_needed

    def watch(self, is_idle: bool) -> None:
        """Take in one integrated timestep; `is_idle` tells whether the robot stands without a command."""
        still = is_idle and np.abs(self._velocity).max() < STILL
        self._still_ticks = self._still_ticks + 1 if still else 0
