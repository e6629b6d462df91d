"""The service compute_arm_ik converts a pose in odom correctly, wherever the robot stands and whatever its heading."""

from __future__ import annotations

import math

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from std_msgs.msg import Header

from humanoid_interfaces.srv import ComputeArmIK
from robot_sim.humanoid import Humanoid
from robot_sim.model.side import Side
from robot_sim.ros.arm_ik_service import ArmIkService

X, Y, YAW = 1.3, -0.4, 2.0
SUCCESS = ComputeArmIK.Response.SUCCESS


class StandInNode:
    """Stands for the node, with only the methods that the service uses."""

    def create_service(self, service_type, name, answer):
        self.answer = answer

    def get_clock(self):
        return self

    def now(self):
        return self

    def to_msg(self):
        return Time(sec=7)


@pytest.fixture
def held() -> Humanoid:
    """A robot on the stand: its body does not move, so the same pose in odom and base_link has the same solution."""
    robot = Humanoid("stand")
    robot.reset(X, Y, YAW)
    return robot


def ask(humanoid: Humanoid, hand_pose: PoseStamped, with_waist: bool = False) -> ComputeArmIK.Response:
    node = StandInNode()
    ArmIkService(node, humanoid)
    request = ComputeArmIK.Request(arm="l", hand_pose=hand_pose, with_waist=with_waist)
    return node.answer(request, ComputeArmIK.Response())


def pose(position, quaternion, frame) -> PoseStamped:
    x, y, z = map(float, position)
    qx, qy, qz, qw = map(float, quaternion)
    return PoseStamped(
        header=Header(frame_id=frame),
        pose=Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw)),
    )


@pytest.mark.parametrize("oriented", [False, True])
def test_a_pose_in_odom_is_the_one_in_base_link_seen_from_elsewhere(held, oriented):
    forward, left, up = 0.32, 0.22, 0.3
    ahead = (0, 0, 0, 1) if oriented else (0, 0, 0, 0)
    turned = (0, 0, math.sin(YAW / 2), math.cos(YAW / 2)) if oriented else (0, 0, 0, 0)
    in_odom = (
        X + forward * math.cos(YAW) - left * math.sin(YAW),
        Y + forward * math.sin(YAW) + left * math.cos(YAW),
        held.base_pose().position[2] + up,
    )
    near = ask(held, pose((forward, left, up), ahead, "base_link"))
    far = ask(held, pose(in_odom, turned, "odom"))
    assert (near.error_code, far.error_code) == (SUCCESS, SUCCESS), (near.message, far.message)
    assert list(far.joint_state.position) == pytest.approx(list(near.joint_state.position), abs=1e-3)
    assert far.joint_state.header.stamp.sec == 7


@pytest.mark.parametrize("scene", ["flat", "table"])
def test_for_the_hands_present_pose_the_answer_is_the_present_posture(scene):
    robot = Humanoid(scene)
    robot.reset(X, Y, YAW, height=0.5)
    hand = robot.hands[Side.LEFT].pose
    answer = ask(robot, pose(hand.position, hand.quaternion, "odom"))
    joints = [robot.data.joint(name).qpos[0] for name in answer.joint_state.name]
    assert len(joints) == 7
    assert np.array(answer.joint_state.position) == pytest.approx(np.array(joints), abs=1e-6)


def test_a_stand_holds_the_waist_too(held):
    place = pose((0.32, 0.22, 0.3), (0, 0, 0, 0), "base_link")
    assert "waist_yaw" not in ask(held, place, with_waist=True).joint_state.name
    assert "waist_yaw" in ask(Humanoid(), place, with_waist=True).joint_state.name
