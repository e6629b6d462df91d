"""The service compute_arm_ik."""

from __future__ import annotations

import math
from functools import cached_property

import mujoco
import numpy as np
from geometry_msgs.msg import PoseStamped
from rclpy.node import Node

from humanoid_interfaces.srv import ComputeArmIK
from robot_sim.arms.inverse_kinematics import (
    ArmInverseKinematics,
    ArmPosture,
    HandGoal,
    Unreachable,
)
from robot_sim.humanoid import Humanoid
from robot_sim.model.side import SIDES, Side

ARMS = {side.letter: side for side in SIDES}
FRAMES = ("odom", "base_link")
QUATERNION_TOLERANCE = 0.01  # allowed deviation of a quaternion's length from 1


class ArmIkService:
    """The service that finds an arm's joint angles for a pose of its hand, on the humanoid's node.

    Nothing moves: the caller sends the angles to joint_trajectory.
    """

    def __init__(self, node: Node, humanoid: Humanoid) -> None:
        self._node = node
        self._humanoid = humanoid
        node.create_service(ComputeArmIK, "compute_arm_ik", self._answer)

    @cached_property
    def _kinematics(self) -> ArmInverseKinematics:
        """The solver, made at the first request, because it takes time that most robots can save."""
        return ArmInverseKinematics(self._humanoid.model)

    def _answer(
        self, request: ComputeArmIK.Request, response: ComputeArmIK.Response
    ) -> ComputeArmIK.Response:
        try:
            posture = self._solve(request)
        except _IkError as error:
            response.error_code, response.message = error.code, str(error)
            return response
        response.error_code, response.message = ComputeArmIK.Response.SUCCESS, "reachable"
        response.joint_state.header.stamp = self._node.get_clock().now().to_msg()
        response.joint_state.name = list(posture.names)
        response.joint_state.position = list(posture.positions)
        return response

    def _solve(self, request: ComputeArmIK.Request) -> ArmPosture:
        side = _side(request.arm)
        if not self._humanoid.body.movable:
            raise _IkError(ComputeArmIK.Response.NO_IK_SOLUTION, "this robot's arms cannot be commanded")
        position, rotation = self._in_base_link(request.hand_pose)
        is_free = not self._humanoid.is_held  # a stand holds the waist too
        balancing = is_free and request.hand_pose.header.frame_id == "odom"
        goal = HandGoal(position, rotation, is_free and request.with_waist, balancing)
        try:
            return self._kinematics.solve(self._humanoid.data, side, goal)
        except Unreachable as error:
            raise _IkError(
                ComputeArmIK.Response.NO_IK_SOLUTION, f"hand_pose is out of reach: {error}"
            ) from None

    def _in_base_link(self, hand_pose: PoseStamped) -> tuple[np.ndarray, np.ndarray | None]:
        """Return a pose's position (3,) m and rotation (3, 3) in the present base_link; None for any rotation."""
        frame = hand_pose.header.frame_id
        if frame not in FRAMES:
            raise _IkError(
                ComputeArmIK.Response.FRAME_TRANSFORM_FAILURE,
                f"hand_pose is in frame {frame[:40]!r}; expected {' or '.join(FRAMES)}",
            )
        position, rotation = _position(hand_pose), _rotation(hand_pose)
        if frame == "odom":
            base = self._humanoid.base_pose()
            to_odom = _matrix(base.quaternion)
            position = to_odom.T @ (position - base.position)
            rotation = None if rotation is None else to_odom.T @ rotation
        return position, rotation


class _IkError(Exception):
    """The request has no solution; `code` and message go into the response."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


def _side(arm: str) -> Side:
    if arm not in ARMS:
        raise _IkError(
            ComputeArmIK.Response.INVALID_GROUP_NAME, f"arm {arm[:40]!r} is not known; expected 'l' or 'r'"
        )
    return ARMS[arm]


def _position(hand_pose: PoseStamped) -> np.ndarray:
    point = hand_pose.pose.position
    position = np.array([point.x, point.y, point.z])
    if not np.isfinite(position).all():
        raise _IkError(
            ComputeArmIK.Response.NO_IK_SOLUTION,
            f"hand_pose has the position {position.tolist()}; expected three finite numbers in m",
        )
    return position


def _rotation(hand_pose: PoseStamped) -> np.ndarray | None:
    """Return the rotation (3, 3) of a pose; None if its quaternion is all zeros."""
    numbers = hand_pose.pose.orientation
    quaternion = np.array([numbers.x, numbers.y, numbers.z, numbers.w])
    if not quaternion.any():
        return None
    length = float(np.linalg.norm(quaternion))
    if not math.isclose(length, 1.0, abs_tol=QUATERNION_TOLERANCE):  # NaN is not close either
        raise _IkError(
            ComputeArmIK.Response.NO_IK_SOLUTION,
            f"hand_pose has a quaternion of length {length:.3g}; expected 1, or four zeros for any orientation",
        )
    return _matrix(quaternion / length)


def _matrix(quaternion: np.ndarray) -> np.ndarray:
    """Return the rotation matrix (3, 3) of a quaternion (x, y, z, w)."""
    matrix = np.empty(9)
    mujoco.mju_quat2Mat(matrix, np.roll(quaternion, 1))  # MuJoCo has w first
    return matrix.reshape(3, 3)
