"""How stiffly the trunk is held upright: the gains of humanoid_interfaces/BalanceGains."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import mujoco
import numpy as np

from robot_sim.model.gravity import GRAVITY
from robot_sim.model.side import SIDES
from robot_sim.walking.balance_parameters import BalanceParameters
from robot_sim.walking.planar import clamp

UNLIMITED = 1e4  # N·m, more than any motion needs


@dataclass(frozen=True)
class BalanceGains:
    """Torques about the hips that hold the trunk upright: kp·angle - kd·rate, at most `max_torque`.

    Gravity topples a leaning trunk with `Trunk.topple` (N·m/rad): with a lower kp the robot falls over, and a kd too
    large for the controller's 200 Hz makes it oscillate and fall.

    Attributes:
        kp_pitch, kp_roll: N·m/rad.
        kd_pitch, kd_roll: N·m·s/rad.
        max_torque: N·m.

    Raises:
        ValueError: a number is negative or not finite, or `max_torque` is 0.
    """

    kp_pitch: float
    kd_pitch: float
    kp_roll: float
    kd_roll: float
    max_torque: float

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not (math.isfinite(value) and value >= 0):
                raise ValueError(f"{field.name} is {value}; expected a finite number that is not negative")
        if self.max_torque == 0:
            raise ValueError(
                "max_torque is 0; expected more than 0, because these torques hold the robot upright"
            )

    def roll_torque(self, error: float, rate: float) -> float:
        """Return the torque (N·m) about the roll axis that corrects a tilt error (rad), at this rate (rad/s)."""
        return clamp(self.kp_roll * error - self.kd_roll * rate, -self.max_torque, self.max_torque)

    def pitch_torque(self, error: float, rate: float) -> float:
        """Return the torque (N·m) about the pitch axis that corrects a tilt error (rad), at this rate (rad/s)."""
        return clamp(self.kp_pitch * error - self.kd_pitch * rate, -self.max_torque, self.max_torque)


@dataclass(frozen=True)
class Trunk:
    """Everything except the legs, as one inverted pendulum on the hips.

    Attributes:
        roll_inertia, pitch_inertia: about the hips, kg·m².
        topple: torque of gravity per angle of tilt, m·g·h, N·m/rad.
    """

    roll_inertia: float
    pitch_inertia: float
    topple: float


def default_gains(trunk: Trunk, balance: BalanceParameters) -> BalanceGains:
    """Return the gains that the walking controller was tuned with."""
    return BalanceGains(
        kp_pitch=balance.tilt_stiffness * trunk.pitch_inertia + trunk.topple,
        kd_pitch=balance.tilt_damping * trunk.pitch_inertia,
        kp_roll=balance.tilt_stiffness * trunk.roll_inertia + trunk.topple,
        kd_roll=balance.tilt_damping * trunk.roll_inertia,
        max_torque=UNLIMITED,
    )


def trunk_of(model: mujoco.MjModel) -> Trunk:
    """Return the trunk of a robot in its model's reference posture.

    Steiner's theorem over the bodies: I = Σ (R I_c Rᵀ + m (r² 1 - r rᵀ)).
    """
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    pelvis = model.body("pelvis").id
    legs = {model.body(f"{side.letter}_hip_yaw_link").id for side in SIDES}
    inertia, moment = np.zeros((3, 3)), 0.0
    for body in range(model.nbody):
        if model.body_rootid[body] != pelvis or legs & set(_ancestors(model, body)):
            continue
        mass, rotation = model.body_mass[body], data.ximat[body].reshape(3, 3)
        arm = data.xipos[body] - data.xpos[pelvis]
        inertia += rotation @ np.diag(model.body_inertia[body]) @ rotation.T
        inertia += mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        moment += mass * arm[2]
    return Trunk(float(inertia[0, 0]), float(inertia[1, 1]), float(moment) * GRAVITY)


def _ancestors(model: mujoco.MjModel, body: int) -> list[int]:
    """Return the body and all bodies above it in the tree, without the world."""
    chain = []
    while body > 0:
        chain.append(body)
        body = int(model.body_parentid[body])
    return chain
