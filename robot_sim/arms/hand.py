"""A hand of two fingers that slide apart."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from robot_sim.model.joint_names import finger_joints
from robot_sim.model.side import Side
from robot_sim.state import HandPose

WIDEST = 0.09  # m between the pads
TIME_CONSTANT = 1.0 / (2.0 * math.pi * 5.0)  # s, of the force sensor: a low pass of 5 Hz, published at 20 Hz


class Hand:
    """The gripper of a side; both fingers move alike."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, side: Side) -> None:
        joints = finger_joints(side)
        self._data = data
        self._motors = [model.actuator(name).id for name in joints]
        self._slides = [model.joint(name).qposadr[0] for name in joints]
        self._grip = data.site(f"{side.letter}_grip")
        self._sensors = data.sensordata
        self._touches = [int(model.sensor(f"{name}_touch").adr[0]) for name in joints]
        self._felt = (0.0, 0.0)  # N, of each pad, by the force sensor

    def open_to(self, opening: float) -> None:
        """Bring the pads `opening` (m) apart; values beyond 0 to 0.09 m are clamped.

        If an object is in between, each finger presses with 800 N/m times its position error, at most 25 N.

        Raises:
            ValueError: the opening is not finite.
        """
        if not math.isfinite(opening):
            raise ValueError(f"the opening is {opening}; expected 0 to {WIDEST} m")
        self._data.ctrl[self._motors] = min(max(opening, 0.0), WIDEST) / 2

    @property
    def pose(self) -> HandPose:
        """Pose of the point between the pads."""
        quaternion = np.empty(4)
        mujoco.mju_mat2Quat(quaternion, self.rotation.ravel())
        return HandPose(self._grip.xpos.copy(), np.roll(quaternion, -1))  # MuJoCo has w first

    @property
    def rotation(self) -> np.ndarray:
        """Rotation matrix (3, 3) of the hand in the world frame: x along the fingers, y in their opening direction."""
        return hand_rotation(self._grip.xmat)

    @property
    def opening(self) -> float:
        """Distance of the pads, m."""
        return float(self._data.qpos[self._slides].sum())

    def tick(self, timestep: float) -> None:
        """Update the force sensor for one timestep (s): it is a first-order low pass of the contact forces.

        When a hand jerks, a pad that presses with 10 N can lose contact for 5 ms without dropping the object.
        """
        share = timestep / (timestep + TIME_CONSTANT)
        first, second = self._felt
        one, other = self._touches
        first += share * (float(self._sensors[one]) - first)
        second += share * (float(self._sensors[other]) - second)
        self._felt = first, second

    @property
    def forces(self) -> tuple[float, float]:
        """Contact force of each pad at this moment, N."""
        first, second = self._sensors[self._touches].tolist()
        return first, second

    @property
    def grip_force(self) -> float:
        """Force on a held object by the force sensor, N, rounded to three digits: that of the pad that presses less."""
        return round(min(self._felt), 3)


def hand_rotation(grip: np.ndarray) -> np.ndarray:
    """Return the rotation matrix (3, 3) of a hand, given that (9,) of its grip site.

    The hand's x axis points along the fingers; it is the site's -z axis. The hand's y axis is the opening direction; it
    is the site's y axis. So a hand that points ahead, with its fingers side by side, has the axes of base_link.
    """
    x, y, z = grip.reshape(3, 3).T
    return np.column_stack((-z, y, x))
