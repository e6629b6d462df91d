"""Position servos driven without lag, by feed-forward of the torque that the motion needs."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

RANGE_MARGIN = 0.02  # rad, kept from the joints' stops


class Servos:
    """Position servos of `joints`, in that order.

    A servo alone sags under gravity and trails a motion, because its torque is kp·(ctrl - q) - kv·q̇. The command
    therefore adds the forces of the rigid body (`qfrc_bias`) and the damping of the wanted motion:
    ctrl = q_ref + (bias + kv·q̇_ref) / kp (computed-torque feed-forward; B. Siciliano et al., "Robotics: Modelling,
    Planning and Control", 2009, section 8.5).

    Attributes:
        low, high: (n,) rad, the range that references are kept in.
        dofs: (n,) indices of the joints' velocities in MuJoCo's arrays.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, joints: Sequence[str]) -> None:
        ids = [model.joint(name).id for name in joints]
        self._data = data
        self._positions = model.jnt_qposadr[ids].copy()
        self.dofs = model.jnt_dofadr[ids].copy()
        self._motors = np.array([model.actuator(name).id for name in joints])
        self._stiffness = model.actuator_gainprm[self._motors, 0].copy()
        self._damping = -model.actuator_biasprm[self._motors, 2]
        self.low = model.jnt_range[ids, 0] + RANGE_MARGIN
        self.high = model.jnt_range[ids, 1] - RANGE_MARGIN

    @property
    def position(self) -> np.ndarray:
        """Measured positions (n,), rad."""
        return self._data.qpos[self._positions]

    def command(self, position: np.ndarray, velocity: np.ndarray) -> None:
        """Command positions (n,), rad, that change at velocities (n,), rad/s."""
        support = self._data.qfrc_bias[self.dofs] + self._damping * velocity
        self._data.ctrl[self._motors] = position + support / self._stiffness
