"""The services and topics under /sim: pause, step, reset, push, hold, charge, real-time factor."""

import time

import pytest
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Vector3
from nav_msgs.msg import Odometry
from rclpy.qos import qos_profile_sensor_data
from robot_process import LATCHED, NAMESPACE, running_robot
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import BatteryState, JointState
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from g1 import ROBOTS
from humanoid_interfaces.msg import RobotState
from humanoid_interfaces.srv import SetFloat64


@pytest.fixture
def robot(request):
    with running_robot("--robot", getattr(request, "param", "humanoid")) as listener:
        yield listener


def seconds(clock):
    return clock.clock.sec + clock.clock.nanosec * 1e-9


def number(robot, name, data):
    return robot.call(SetFloat64, f"/sim/{name}", SetFloat64.Request(data=data))


def test_a_paused_simulation_stands_still_and_steps_the_requested_time(robot):
    clock = []
    robot.node.create_subscription(Clock, "/clock", lambda message: clock.append(seconds(message)), 10)
    robot.one(Clock, "/clock")
    assert robot.call(SetBool, "/sim/set_pause", SetBool.Request(data=True)).success
    time.sleep(0.3)  # no message may arrive in this time
    paused_at = clock[-1]
    assert number(robot, "step_simulation", 0.5).message == "100 steps of 5 ms"
    robot.one(Clock, "/clock", until=lambda message: seconds(message) > paused_at + 0.45)
    time.sleep(0.3)
    assert clock[-1] == pytest.approx(paused_at + 0.5, abs=0.05)
    assert robot.call(SetBool, "/sim/set_pause", SetBool.Request(data=False)).success
    robot.one(Clock, "/clock", until=lambda message: seconds(message) > paused_at + 0.7)


def test_only_a_paused_simulation_is_stepped(robot):
    answer = number(robot, "step_simulation", 0.1)
    assert not answer.success
    assert "pause it first" in answer.message
    robot.call(SetBool, "/sim/set_pause", SetBool.Request(data=True))
    assert "expected more than 0" in number(robot, "step_simulation", -1.0).message


@pytest.mark.parametrize("robot", ROBOTS, indirect=True)
def test_reset_stands_the_fallen_robot_up_at_the_origin(robot):
    robot.publish(Vector3(x=90.0), "/sim/push")
    robot.one(RobotState, "robot_state", LATCHED, until=lambda state: state.mode == RobotState.FALLEN)
    assert robot.call(Trigger, "/sim/reset_world", Trigger.Request()).success
    state = robot.one(
        RobotState, "robot_state", LATCHED, until=lambda state: state.mode == RobotState.STANDING
    )
    assert (state.motors_enabled, state.steps) == (True, 0)
    pose = robot.one(Odometry, "odom", until=lambda odometry: odometry.pose.pose.position.z > 0.55).pose.pose
    assert (pose.position.x, pose.position.y) == pytest.approx((0.0, 0.0), abs=0.05)
    robot.one(JointState, "joint_states", qos_profile_sensor_data)


def test_the_battery_is_set(robot):
    assert number(robot, "set_battery", 0.25).message == "25%"
    battery = robot.one(BatteryState, "battery_state", LATCHED, until=lambda state: state.percentage < 0.5)
    assert battery.percentage == pytest.approx(0.25, abs=0.01)
    refused = number(robot, "set_battery", 25.0)
    assert (refused.success, "expected 0 (empty) to 1 (full)" in refused.message) == (False, True)


def test_the_pace_is_set(robot):
    assert number(robot, "set_real_time_factor", 4.0).success
    first = robot.one(Clock, "/clock")
    began = time.monotonic()
    robot.one(Clock, "/clock", until=lambda message: seconds(message) > seconds(first) + 8.0)
    assert time.monotonic() - began < 7.0
    assert "expected 0" in number(robot, "set_real_time_factor", -1.0).message


def test_a_joint_is_held_until_another_name_or_an_empty_one(robot):
    def bend(joint, position):
        point = JointTrajectoryPoint(positions=[position], time_from_start=Duration(sec=1))
        robot.publish(JointTrajectory(joint_names=[joint], points=[point]), "joint_trajectory")

    def positions_of(joint, count):
        messages = robot.collect(JointState, "joint_states", count, qos_profile_sensor_data)
        return [message.position[message.name.index(joint)] for message in messages]

    robot.publish(String(data="l_elbow_2"), "/sim/hold_joint")  # a joint that does not exist
    robot.publish(String(data="l_elbow"), "/sim/hold_joint")
    bend("l_elbow", -1.5)
    # in two seconds; on a busy machine the command may come before the hold
    assert min(positions_of("l_elbow", 40)) > -1.0
    robot.publish(String(data="r_elbow"), "/sim/hold_joint")
    assert positions_of("l_elbow", 40)[-1] == pytest.approx(-1.5, abs=0.02)
    bend("r_elbow", -1.5)
    assert min(positions_of("r_elbow", 40)) > -1.0
    robot.publish(String(), "/sim/hold_joint")
    assert positions_of("r_elbow", 40)[-1] == pytest.approx(-1.5, abs=0.02)


def test_a_graded_robot_has_no_controls():
    with running_robot("--control-fd", "0") as robot:
        names = {name for name, _ in robot.node.get_service_names_and_types()}
        assert any(name.startswith(NAMESPACE) for name in names)
        assert not any(name.startswith("/sim/") for name in names)
