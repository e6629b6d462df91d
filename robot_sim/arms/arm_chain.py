"""The joints between the body and a hand, for the inverse kinematics."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from robot_sim.arms.servos import RANGE_MARGIN
from robot_sim.model.joint_names import ARM, WAIST, arm_joints
from robot_sim.model.posture import on_side
from robot_sim.model.side import Side

# The posture that searches and motions prefer, with the elbow away from the body: rad, left arm; other joints 0.
RELAXED_ARM = {"shoulder_pitch": 0.3, "shoulder_roll": 0.7, "elbow": -1.4}


class ArmChain:
    """The seven joints of an arm, with waist_yaw before them if it may turn.

    Attributes:
        names: of the joints.
        positions, dofs: their indices (n,) in MuJoCo's positions and velocities.
        low, high: (n,) rad, the range that the servos keep them in.
        relaxed: (n,) rad, with the elbow away from the body.
        grip: index of the site between the pads.
    """

    def __init__(self, model: mujoco.MjModel, side: Side, with_waist: bool) -> None:
        waist = WAIST[:1] if with_waist else ()
        self.names = (*waist, *arm_joints(side))
        joints = [model.joint(name).id for name in self.names]
        self.positions = model.jnt_qposadr[joints].copy()
        self.dofs = model.jnt_dofadr[joints].copy()
        self.low = model.jnt_range[joints, 0] + RANGE_MARGIN
        self.high = model.jnt_range[joints, 1] - RANGE_MARGIN
        self.relaxed = np.array([0.0] * len(waist) + relaxed_arm(side))
        self.grip = model.site(f"{side.letter}_grip").id
        self._model = model
        self._turns = with_waist
        self._shoulder = model.body(f"{side.letter}_shoulder_pitch_link").id
        self._length = self._lengths_from_shoulder_to_grip()
        self._is_arm = _descendants(model, self._shoulder)
        self._is_robot = model.body_rootid == model.body("pelvis").id

    def metres_short(self, data: mujoco.MjData, position: np.ndarray) -> float:
        """Return at least how much (m) the stretched arm is too short to reach `position` (3,); 0: long enough."""
        shoulder = data.xpos[self._shoulder]
        if not self._turns:
            return max(0.0, float(np.linalg.norm(position - shoulder)) - self._length)
        axis = data.xpos[self._model.body("waist").id]  # the shoulder turns around the waist
        out = math.dist(position[:2], axis[:2]) - math.dist(shoulder[:2], axis[:2])
        return max(0.0, math.hypot(out, position[2] - shoulder[2]) - self._length)

    def touches_the_robot(self, data: mujoco.MjData) -> bool:
        """Return whether the arm meets another part of the robot in the contacts of `data`."""
        bodies = self._model.geom_bodyid[data.contact.geom[: data.ncon]]
        if not len(bodies):
            return False
        one_is_arm = self._is_arm[bodies].sum(axis=1) == 1
        return bool((one_is_arm & self._is_robot[bodies].all(axis=1)).any())

    def _lengths_from_shoulder_to_grip(self) -> float:
        length = float(np.linalg.norm(self._model.site_pos[self.grip]))
        body = self._model.site_bodyid[self.grip]
        while body != self._shoulder:
            length += float(np.linalg.norm(self._model.body_pos[body]))
            body = self._model.body_parentid[body]
        return length


def _descendants(model: mujoco.MjModel, root: int) -> np.ndarray:
    """Return for each body whether it is `root` or a descendant of it."""
    belongs = np.zeros(model.nbody, dtype=bool)
    belongs[root] = True
    for body in range(root + 1, model.nbody):  # a parent goes before its children
        belongs[body] = belongs[model.body_parentid[body]]
    return belongs


def relaxed_arm(side: Side) -> list[float]:
    """Return the positions (7,) rad of a relaxed arm, with its elbow away from the body."""
    return [on_side(side, joint, RELAXED_ARM.get(joint, 0.0)) for joint in ARM]
