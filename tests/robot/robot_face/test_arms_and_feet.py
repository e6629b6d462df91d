"""The topics of hands, feet and joint limits, received by another node, in each scene."""

from __future__ import annotations

import math

import pytest
from geometry_msgs.msg import PoseStamped, WrenchStamped
from rclpy.qos import qos_profile_sensor_data
from robot_process import LATCHED, running_robot
from sensor_msgs.msg import JointState

from humanoid_interfaces.msg import JointLimits
from humanoid_interfaces.srv import ComputeArmIK

SUCCESS = ComputeArmIK.Response.SUCCESS
SCENES = {"flat": (), "table": ("--scene", "table"), "crouch": ("--crouch",)}
SHOULDER = {"flat": 0.98, "table": 0.98, "crouch": 0.83}  # m above the floor
HANGING = 0.45  # m: the hands are that far below the shoulders
WEIGHT = 373.0  # N


@pytest.fixture(scope="module", params=SCENES)
def scene(request):
    return request.param


@pytest.fixture(scope="module")
def robot(scene):
    with running_robot(*SCENES[scene]) as listener:
        yield listener


def test_the_hands_hang_beside_the_body_and_point_down(robot, scene):
    left, right = (robot.one(PoseStamped, f"{letter}_hand/pose") for letter in "lr")
    assert left.header.frame_id == right.header.frame_id == "odom"
    for hand, sign in ((left, 1), (right, -1)):
        position, q = hand.pose.position, hand.pose.orientation
        assert sign * position.y == pytest.approx(0.24, abs=0.05)
        assert position.z == pytest.approx(SHOULDER[scene] - HANGING, abs=0.05)
        assert 2 * (q.x * q.z - q.w * q.y) < -0.8, "the fingers' x axis points down"


def test_the_feet_carry_the_robot(robot):
    feet = [robot.one(WrenchStamped, f"{letter}_foot/wrench") for letter in "lr"]
    assert [foot.header.frame_id for foot in feet] == ["l_sole", "r_sole"]
    assert sum(foot.wrench.force.z for foot in feet) == pytest.approx(WEIGHT, rel=0.05)


@pytest.mark.parametrize(
    ("message_type", "topic", "rate"),
    [(PoseStamped, "l_hand/pose", 20.0), (WrenchStamped, "r_foot/wrench", 50.0)],
)
def test_hand_and_foot_topics_have_their_documented_rates(robot, message_type, topic, rate):
    stamps = [message.header.stamp for message in robot.collect(message_type, topic, 21)]
    times = [stamp.sec + stamp.nanosec * 1e-9 for stamp in stamps]
    assert (times[-1] - times[0]) / 20 > 0.7 / rate  # a lost message makes the mean longer, never shorter


def test_a_late_subscriber_still_gets_the_joint_limits(robot):
    limits = robot.one(JointLimits, "joint_limits", LATCHED)
    assert len(limits.names) == len(limits.lower) == len(limits.upper) == len(limits.velocity)
    elbow = limits.names.index("r_elbow")
    assert (limits.lower[elbow], limits.upper[elbow]) == pytest.approx((-math.radians(135), 0.0))
    assert limits.velocity[elbow] == pytest.approx(3.0)
    assert limits.velocity[limits.names.index("waist_yaw")] == pytest.approx(1.0)
    joints = robot.one(JointState, "joint_states", qos_profile_sensor_data)
    for name, lower, upper in zip(limits.names, limits.lower, limits.upper, strict=True):
        assert lower < joints.position[joints.name.index(name)] < upper


def test_the_solution_for_the_hands_present_pose_is_the_present_posture(robot):
    hand = robot.one(PoseStamped, "r_hand/pose")
    answer = robot.call(ComputeArmIK, "compute_arm_ik", ComputeArmIK.Request(arm="r", hand_pose=hand))
    assert answer.error_code == SUCCESS, answer.message
    joints = robot.one(JointState, "joint_states", qos_profile_sensor_data)
    present = [joints.position[joints.name.index(name)] for name in answer.joint_state.name]
    assert list(answer.joint_state.position) == pytest.approx(present, abs=0.02)
