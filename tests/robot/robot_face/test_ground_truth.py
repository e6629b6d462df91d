"""The ground truth that the simulator writes to its pipe, and the commands that a scenario sends."""

import json
import os
import threading

import pytest
from rclpy.qos import qos_profile_sensor_data
from robot_process import TIMEOUT, running_robot
from sensor_msgs.msg import Imu, JointState


class Pipes:
    """The pipes of a robot: its ground truth, collected by kind, and its commands."""

    def __init__(self, listener, truth_fd, control_fd):
        self.listener = listener
        self.records = []
        self._control_fd = control_fd
        self._arrived = threading.Condition()
        threading.Thread(target=self._read, args=(truth_fd,), daemon=True).start()

    def command(self, do, **arguments):
        """Send a command and wait until it has taken effect."""
        command = {"do": do, **arguments}
        os.write(self._control_fd, json.dumps(command).encode() + b"\n")
        self.wait_for(lambda record: record.get("command") == command)

    def wait_for(self, wanted):
        with self._arrived:
            assert self._arrived.wait_for(lambda: any(map(wanted, self.records)), TIMEOUT)

    def simulate(self, duration):
        """Let that much simulated time (s) pass."""
        with self._arrived:
            end = duration + max(record.get("simulated", 0.0) for record in self.records)
        self.wait_for(lambda record: record.get("simulated", 0.0) >= end)

    def joint_states(self, count=1, until=lambda message: True):
        return self.listener.collect(JointState, "joint_states", count, qos_profile_sensor_data, until)

    def joints_told(self):
        with self._arrived:
            return [record for record in self.records if record["kind"] == "joints_published"]

    def _read(self, truth_fd):
        with os.fdopen(truth_fd, "rb") as lines:
            for line in lines:
                with self._arrived:
                    self.records.append(json.loads(line))
                    self._arrived.notify_all()


def joints_in(record):
    return record.get("names"), record.get("positions")


@pytest.fixture
def robot():
    """A robot whose joint sensors are unplugged."""
    truth_read, truth_write = os.pipe()
    control_read, control_write = os.pipe()
    fds = ("--ground-truth-fd", str(truth_write), "--control-fd", str(control_read))
    with running_robot("--joint-sensors-unplugged", *fds, pass_fds=(truth_write, control_read)) as listener:
        os.close(truth_write)
        os.close(control_read)
        yield Pipes(listener, truth_read, control_write)
    os.close(control_write)


def test_published_joint_positions_are_recorded_and_only_with_a_subscriber(robot):
    robot.command("joint_sensors", connected=True)
    robot.simulate(0.5)
    assert robot.joints_told() == []
    messages = robot.joint_states(count=3)
    assert len(messages[0].name) == len(messages[0].position) > 30
    for message in messages:
        as_published = (list(message.name), list(message.position))
        robot.wait_for(lambda record, wanted=as_published: joints_in(record) == wanted)


def test_unplugged_joint_sensors_publish_nothing_until_plugged_in(robot):
    heard = threading.Event()
    robot.listener.node.create_subscription(
        JointState, "joint_states", lambda message: heard.set(), qos_profile_sensor_data
    )
    robot.wait_for(
        lambda record: any(
            topic.endswith("joint_states") and count for topic, count in record.get("subscribers", {}).items()
        )
    )
    robot.simulate(0.5)  # s, ten times the period of joint_states
    assert not heard.is_set()
    assert robot.joints_told() == []
    robot.command("joint_sensors", connected=True)
    assert heard.wait(TIMEOUT)


def test_a_scenario_moves_joints_and_reverses_the_order_of_joint_states(robot):
    robot.command("joint_sensors", connected=True)
    (before,) = robot.joint_states()
    robot.command("joint_states", reversed=True)
    robot.command("move_joints", positions={"l_elbow": -1.5, "head_pan": 0.4}, duration=0.2)
    (after,) = robot.joint_states(
        until=lambda message: (
            abs(dict(zip(message.name, message.position, strict=True))["l_elbow"] + 1.5) < 0.01
        )
    )
    assert list(after.name) == list(reversed(before.name))
    positions = dict(zip(after.name, after.position, strict=True))
    assert positions["head_pan"] == pytest.approx(0.4, abs=0.01)
    assert positions["r_elbow"] == pytest.approx(before.position[before.name.index("r_elbow")], abs=0.01)


def test_published_imu_messages_are_recorded_with_the_gyro_bias_of_the_scenario(robot):
    bias = [0.01, -0.02, 0.015]
    robot.command("gyro_bias", bias=bias)
    messages = robot.listener.collect(Imu, "imu", 3, qos_profile_sensor_data, lambda message: True)
    for message in messages:
        velocity = message.angular_velocity
        told = {"angular_velocity": [velocity.x, velocity.y, velocity.z], "gyro_bias": bias}
        robot.wait_for(lambda record, wanted=told: wanted.items() <= record.items())
        assert told["angular_velocity"] == pytest.approx(bias, abs=0.01)


def test_an_unplugged_imu_publishes_nothing_until_plugged_in(robot):
    heard = threading.Event()
    robot.command("imu_sensor", connected=False)
    robot.listener.node.create_subscription(Imu, "imu", lambda message: heard.set(), qos_profile_sensor_data)
    robot.wait_for(
        lambda record: any(
            topic.endswith("imu") and count for topic, count in record.get("subscribers", {}).items()
        )
    )
    robot.simulate(0.5)
    assert not heard.is_set()
    robot.command("imu_sensor", connected=True)
    assert heard.wait(TIMEOUT)
