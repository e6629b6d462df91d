"""Position servos without lag: the torque that the motion needs is fed forward."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

RANGE_MARGIN = 0.02  # rad, kept from the joints' stops


class Servos:
    """Position servos of `joints`, in that order.

    A servo alone sags under gravity and lags behind a motion, because its torque is kp·(ctrl - q) - kv·q̇. The command
    therefore adds the rigid-body forces (`qfrc_bias`) and the damping of the commanded motion:
    ctrl = q_ref + (bias + kv·q̇_ref) / kp (computed-torque feed-forward; B. Siciliano et al., "Robotics: Modelling,
    Planning and Control", 2009, section 8.5).
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, joints: Sequence[str]) -> None:
        ids = np.array([model.joint(name).id for name in joints], dtype=int)
        self._data = data
        self._positions = model.jnt_qposadr[ids].copy()
        self._dofs = model.jnt_dofadr[ids].copy()
        self._motors = np.array([model.actuator(name).id for name in joints], dtype=int)
        self._stiffness = model.actuator_gainprm[self._motors, 0].copy()
        self._damping = -model.actuator_biasprm[self._motors, 2]
        self._low = model.jnt_range[ids, 0] + RANGE_MARGIN
        self._high = model.jnt_range[ids, 1] - RANGE_MARGIN

    @property
    def position(self) -> np.ndarray:
        """Measured positions (n,), rad."""
        return self._data.qpos[self._positions]

    def within_range(self, position: np.ndarray) -> np.ndarray:
        """Return positions (n,), rad, clamped to the joints' ranges; `np.clip` would take several times as long."""
        return np.minimum(np.maximum(position, self._low), self._high)

    def command(self, position: np.ndarray, velocity: np.ndarray) -> None:
        """Command positions (n,), rad, that change at velocities (n,), rad/s."""
        support = self._data.qfrc_bias[self._dofs] + self._damping * velocity
        self._data.ctrl[self._motors] = position + support / self._stiffness
