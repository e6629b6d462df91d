"""Pushes: forces on a body for a limited time."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np


class Pusher:
    """A source of pushes on one body; simultaneous ones add up."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, body: str) -> None:
        self._force = data.xfrc_applied[model.body(body).id, :3]
        self._timestep = model.opt.timestep
        self._pushes: list[tuple[np.ndarray, int]] = []
        self._acts = False  # in the latest step

    def push(self, impulse: Sequence[float], duration: float) -> None:
        """Give `impulse` (3,) N·s in the world frame, evenly over `duration` (s, at least one step).

        Raises:
            ValueError: the impulse is not three finite numbers, or the duration is not positive.
        """
        vector = np.asarray(impulse, dtype=float)
        if vector.shape != (3,) or not np.isfinite(vector).all():
            raise ValueError(f"impulse is {impulse}; expected three finite numbers (x, y, z) in N·s")
        if not duration > 0:
            raise ValueError(f"duration is {duration}; expected more than 0 s")
        steps = max(1, round(duration / self._timestep))
        self._pushes.append((vector / (steps * self._timestep), steps))

    @property
    def is_idle(self) -> bool:
        """Whether no push acted in the latest step or acts in the next one."""
        return not self._pushes and not self._acts

    def apply(self) -> None:
        """Set the force of the next step."""
        if self.is_idle:
            return
        self._acts = bool(self._pushes)
        self._force[:] = sum(force for force, _ in self._pushes) if self._pushes else 0.0
        self._pushes = [(force, steps - 1) for force, steps in self._pushes if steps > 1]
