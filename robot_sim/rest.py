"""When a robot that stands still may be left as it is, because integrating it would change nothing to be seen."""

import mujoco
import numpy as np

STILL = (
    2e-6  # rad/s or m/s; standing, what is left dies away within 0.26 s, so 0.5 µm or µrad are still to come
)
HOLD = 0.1  # s


class Rest:
    """Notices that the robot has come to rest, and that it was stirred.

    Attributes:
        allowed: it may rest at all.
    """

    def __init__(self, data: mujoco.MjData, timestep: float) -> None:
        self.allowed = False
        self._velocity = data.qvel
        self._ticks_needed = round(HOLD / timestep)
        self._still_ticks = 0

    def stir(self) -> None:
        """Something was asked of the body: it is to be integrated until it stands still again."""
        self._still_ticks = 0

    @property
    def has_come(self) -> bool:
        """The body stood still long enough, and nothing was asked of it since."""
        return self._still_ticks >= self._ticks_needed

    def watch(self, is_idle: bool) -> None:
        """Take in one integrated timestep; ``is_idle``: the robot stands, and nothing is asked of its body."""
        still = is_idle and np.abs(self._velocity).max() < STILL
        self._still_ticks = self._still_ticks + 1 if still else 0
