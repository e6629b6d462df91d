"""Brakes that hold a joint in place against its motor, as a person's hand would."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

STIFFNESS = 600.0  # N·m/rad; three times an arm's servo
BRAKE_TORQUE = 80.0  # N·m, twice the torque of an arm's strongest motor


class JointBrakes:
    """Springs on single joints; each pulls its joint back to the position at the time of `hold`.

    A spring acts between the two links of its joint, so it neither lifts the robot nor pushes it over.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, joints: Sequence[str]) -> None:
        self._joints = joints
        self._model, self._data = model, data
        self._held: dict[str, tuple[int, int, float, float]] = {}

    def hold(self, joint: str, grip: float = BRAKE_TORQUE) -> None:
        """Hold a joint with at most `grip` (N·m).

        Raises:
            ValueError: the joint is not one of those that a trajectory moves, or the grip is not positive.
        """
        if joint not in self._joints:
            known = ", ".join(self._joints) or "none of this robot"
            raise ValueError(f"joint {joint!r} cannot be held; the joints are {known}")
        if not 0 < grip < float("inf"):
            raise ValueError(f"grip is {grip}; expected more than 0 N·m")
        position = int(self._model.joint(joint).qposadr[0])
        dof = int(self._model.joint(joint).dofadr[0])
        self._held[joint] = (position, dof, float(self._data.qpos[position]), float(grip))

    def release(self, joint: str) -> None:
        """Release a joint; does nothing if it is not held."""
        if held := self._held.pop(joint, None):
            self._data.qfrc_applied[held[1]] = 0.0

    @property
    def is_idle(self) -> bool:
        """Whether no joint is held."""
        return not self._held

    def apply(self) -> None:
        """Set the torques of the next step."""
        for position, dof, place, grip in self._held.values():
            pull = STIFFNESS * (place - self._data.qpos[position])
            self._data.qfrc_applied[dof] = np.clip(pull, -grip, grip)
