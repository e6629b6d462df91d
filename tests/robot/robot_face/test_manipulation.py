"""The topics of arms, hands and objects, used by another node."""

import math

import pytest
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import PoseStamped, WrenchStamped
from rclpy.qos import qos_profile_sensor_data
from robot_process import running_robot
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint


@pytest.fixture(scope="module")
def robot():
    with running_robot("--scene", "table") as listener:
        yield listener


def joint_reaches(robot, name, position):
    """The first JointState message in which a joint is at a position and at rest."""

    def is_there(message):
        index = message.name.index(name)
        return abs(message.position[index] - position) < 0.01 and abs(message.velocity[index]) < 0.02

    return robot.one(JointState, "joint_states", qos_profile_sensor_data, until=is_there)


def test_a_trajectory_moves_the_joint_it_names(robot):
    point = JointTrajectoryPoint(positions=[-1.2], velocities=[0.0], time_from_start=Duration(sec=1))
    robot.publish(JointTrajectory(joint_names=["l_elbow"], points=[point]), "joint_trajectory")
    joint_reaches(robot, "l_elbow", -1.2)


def test_an_invalid_trajectory_is_ignored(robot):
    leg = JointTrajectoryPoint(positions=[0.0], time_from_start=Duration(sec=1))
    robot.publish(JointTrajectory(joint_names=["l_knee"], points=[leg]), "joint_trajectory")
    head = JointTrajectoryPoint(positions=[0.4], time_from_start=Duration(sec=1))
    robot.publish(JointTrajectory(joint_names=["head_pan"], points=[head]), "joint_trajectory")
    joint_reaches(robot, "head_pan", 0.4)


def test_a_gripper_opens_as_far_as_commanded(robot):
    robot.publish(Float64(data=math.nan), "r_gripper/command")
    robot.publish(Float64(data=0.06), "r_gripper/command")
    joints = joint_reaches(robot, "r_finger_1", 0.03)
    assert joints.position[joints.name.index("r_finger_2")] == pytest.approx(0.03, abs=0.01)


def test_closed_fingers_measure_a_contact_force(robot):
    robot.publish(Float64(data=0.0), "l_gripper/command")
    wrench = robot.one(WrenchStamped, "l_gripper/wrench", until=lambda message: message.wrench.force.y >= 0.0)
    assert wrench.header.frame_id == "l_hand"


def test_the_cup_is_seen_on_the_table(robot):
    cup = robot.one(PoseStamped, "objects/cup/pose")
    position = cup.pose.position
    assert cup.header.frame_id == "odom"
    assert (position.x, position.y, position.z) == pytest.approx((0.33, -0.15, 0.755), abs=0.01)
