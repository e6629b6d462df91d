"""The robots' topics, rates, frames and commands, used by another node.

One robot of each kind serves the tests that leave it standing.
"""

import math
import time

import pytest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.qos import qos_profile_sensor_data
from robot_process import LATCHED, running_robot
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import BatteryState, Imu, JointState
from std_msgs.msg import Bool

from g1 import ROBOTS
from humanoid_interfaces.msg import JointLimits, RobotState
from humanoid_interfaces.srv import ComputeArmIK


@pytest.fixture(scope="module", params=ROBOTS)
def kind(request):
    return request.param


@pytest.fixture(scope="module")
def robot(kind):
    with running_robot("--robot", kind) as listener:
        yield listener


@pytest.fixture
def robot_that_may_fall(kind):
    with running_robot("--robot", kind) as listener:
        yield listener


def publish_until(robot, message, topic, done):
    """Publish at 10 Hz until `done(odometry)`; returns that odometry."""
    publisher = robot.node.create_publisher(type(message), topic, 10)
    timer = robot.node.create_timer(0.1, lambda: publisher.publish(message))
    try:
        return robot.one(Odometry, "odom", until=done)
    finally:
        robot.node.destroy_timer(timer)
        robot.node.destroy_publisher(publisher)


def is_still(odometry):
    return math.hypot(odometry.twist.twist.linear.x, odometry.twist.twist.linear.y) < 0.02


def test_a_late_subscriber_still_gets_battery_and_state(robot):
    battery = robot.one(BatteryState, "battery_state", LATCHED)
    assert 0.0 < battery.percentage <= 1.0
    assert battery.current < 0.0, "negative while discharging"
    assert battery.voltage > 0.0
    assert math.isnan(battery.temperature), "NaN where nothing is measured"
    unset = BatteryState()
    fields = {name: getattr(battery, name) for name in battery.get_fields_and_field_types()}
    bare = [name for name, value in fields.items() if value == getattr(unset, name)]
    assert bare == [], "a copy without this field would be taken for whole"
    state = robot.one(RobotState, "robot_state", LATCHED)
    assert (state.mode, state.motors_enabled) == (RobotState.STANDING, True)


def test_odom_is_the_pelvis_in_odom(robot, kind):
    odometry = robot.one(Odometry, "odom")
    assert (odometry.header.frame_id, odometry.child_frame_id) == ("odom", "base_link")
    stance = {"humanoid": 0.60, "g1": 0.76}[kind]  # m
    assert odometry.pose.pose.position.z == pytest.approx(stance, abs=0.03)


def test_joint_states_name_every_joint_once(robot, kind):
    joints = robot.one(JointState, "joint_states", qos_profile_sensor_data)
    assert (
        len(set(joints.name))
        == len(joints.name)
        == len(joints.position)
        == len(joints.velocity)
        == len(joints.effort)
    )
    some = {
        "humanoid": {"l_knee", "r_knee", "waist_yaw", "l_elbow", "r_shoulder_pitch"},
        "g1": {"left_knee_joint", "right_hip_pitch_joint", "waist_yaw_joint", "left_elbow_joint"},
    }
    assert some[kind] <= set(joints.name)


def test_a_trajectory_can_move_joints_only_if_the_walker_leaves_some(robot, kind):
    limits = robot.one(JointLimits, "joint_limits", LATCHED)
    answer = robot.call(ComputeArmIK, "compute_arm_ik", ComputeArmIK.Request(arm="l"))
    refused = answer.message == "this robot's arms cannot be commanded"
    assert (len(limits.names) == 0, refused) == (kind == "g1", kind == "g1")


def test_the_imu_measures_gravity(robot):
    imu = robot.one(Imu, "imu", qos_profile_sensor_data)
    assert imu.header.frame_id == "imu_link"
    assert imu.linear_acceleration.z == pytest.approx(9.81, abs=0.5)
    norm = math.hypot(imu.orientation.x, imu.orientation.y, imu.orientation.z, imu.orientation.w)
    assert norm == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(
    ("message_type", "topic", "rate"),
    [(Odometry, "odom", 20.0), (JointState, "joint_states", 20.0), (Imu, "imu", 50.0)],
)
def test_topics_have_their_documented_rates_in_simulated_time(robot, message_type, topic, rate):
    messages = robot.collect(message_type, topic, 21, qos_profile_sensor_data)
    stamps = [message.header.stamp.sec + message.header.stamp.nanosec * 1e-9 for message in messages]
    assert stamps == sorted(stamps)
    # best-effort messages may be lost on a loaded machine, which makes the mean longer, never shorter
    assert (stamps[-1] - stamps[0]) / 20 > 0.7 / rate


def test_the_simulator_publishes_the_clock(robot):
    first, second = robot.collect(Clock, "/clock", 2)
    assert second.clock.sec + second.clock.nanosec * 1e-9 > first.clock.sec + first.clock.nanosec * 1e-9


def test_cmd_vel_walks_and_a_stale_command_stops(robot):
    start = robot.one(Odometry, "odom", until=is_still).pose.pose.position.x
    ahead = Twist()
    ahead.linear.x = 0.3
    walked = publish_until(
        robot, ahead, "cmd_vel", lambda odometry: odometry.pose.pose.position.x > start + 0.3
    )
    assert walked.pose.pose.position.z > 0.5, "upright"
    stopped = robot.collect(Odometry, "odom", 10, until=is_still)[-1]
    assert stopped.pose.pose.position.x < walked.pose.pose.position.x + 0.6
    assert (
        robot.one(
            RobotState, "robot_state", LATCHED, until=lambda state: state.mode == RobotState.STANDING
        ).steps
        > 0
    )


def test_a_command_that_is_not_finite_is_ignored(robot):
    nonsense = Twist()
    nonsense.linear.x = math.nan
    deadline = time.monotonic() + 1.0
    after = publish_until(robot, nonsense, "cmd_vel", lambda odometry: time.monotonic() > deadline)
    assert is_still(after)
    assert robot.one(RobotState, "robot_state", LATCHED).mode == RobotState.STANDING


def test_without_motor_power_it_falls(robot_that_may_fall):
    robot = robot_that_may_fall
    publisher = robot.node.create_publisher(Bool, "motor_power", 10)
    robot.node.create_timer(0.2, lambda: publisher.publish(Bool(data=False)))
    state = robot.one(RobotState, "robot_state", LATCHED, until=lambda state: state.mode == RobotState.FALLEN)
    assert not state.motors_enabled
