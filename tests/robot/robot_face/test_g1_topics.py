"""The G1 has the same topics and services as the course's own robot, as far as it has the parts."""

from __future__ import annotations

import pytest
from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from rclpy.qos import qos_profile_sensor_data
from robot_process import LATCHED, running_robot
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

from g1 import needs_g1
from humanoid_interfaces.msg import JointLimits, RobotState
from humanoid_interfaces.srv import ComputeArmIK

pytestmark = needs_g1


@pytest.fixture(scope="module")
def robot():
    with running_robot("--robot", "g1", "--rtf", "2") as listener:
        yield listener


def state(robot, mode):
    return robot.one(RobotState, "robot_state", LATCHED, until=lambda each: each.mode == mode)


def test_its_joints_have_names_of_their_own_and_no_trajectory_moves_them(robot):
    joints = robot.one(JointState, "joint_states", qos_profile_sensor_data)
    assert len(joints.name) == len(joints.position) == len(joints.velocity) == 29
    assert "left_hip_pitch_joint" in joints.name
    assert robot.one(JointLimits, "joint_limits", LATCHED).names == []
    answer = robot.call(ComputeArmIK, "compute_arm_ik", ComputeArmIK.Request(arm="l"))
    assert answer.error_code == ComputeArmIK.Response.NO_IK_SOLUTION
    assert answer.message == "this robot's arms cannot be commanded"


def test_it_has_the_same_frames(robot):
    odom = robot.one(Odometry, "odom")
    assert (odom.header.frame_id, odom.child_frame_id) == ("odom", "base_link")
    assert robot.one(Imu, "imu", qos_profile_sensor_data).header.frame_id == "imu_link"


def test_it_walks_until_the_last_command_is_old_and_can_be_paused(robot):
    command = Twist()
    command.linear.x = 0.3
    robot.publish(command, "cmd_vel")
    state(robot, RobotState.WALKING)
    state(robot, RobotState.STANDING)
    assert robot.call(SetBool, "/sim/set_pause", SetBool.Request(data=True)).message == "paused"
    assert robot.call(SetBool, "/sim/set_pause", SetBool.Request(data=False)).message == "running"


def test_a_push_or_a_loss_of_power_makes_it_fall_and_a_reset_puts_it_back(robot):
    for fall in (
        lambda: robot.publish(Vector3(y=60.0), "/sim/push"),
        lambda: robot.publish(Bool(), "motor_power"),
    ):
        fall()
        assert not state(robot, RobotState.FALLEN).motors_enabled
        assert robot.call(Trigger, "/sim/reset_world", Trigger.Request()).success
        assert state(robot, RobotState.STANDING).motors_enabled
