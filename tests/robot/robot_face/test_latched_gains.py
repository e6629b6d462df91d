"""The robot uses balance gains of any publisher, also those that were published before it started."""

import time

import pytest
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile

from humanoid_interfaces.msg import BalanceGains
from robot_sim.humanoid import Humanoid
from robot_sim.ros.node import HumanoidNode

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
GAINS = BalanceGains(kp_pitch=321.0, kd_pitch=41.0, kp_roll=322.0, kd_roll=42.0, max_torque=1000.0)
PATIENCE = 10.0  # s


@pytest.fixture
def operator():
    """A node that publishes gains."""
    rclpy.init()
    node = rclpy.create_node("operator", namespace="/robot")
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def takes_the_gains(robot, meanwhile=lambda: None):
    """Return whether the robot has the gains within some seconds."""
    deadline = time.monotonic() + PATIENCE
    while robot.humanoid.balance_gains.kp_pitch != GAINS.kp_pitch and time.monotonic() < deadline:
        meanwhile()
        robot.process_commands()
        time.sleep(0.02)
    return robot.humanoid.balance_gains.kd_roll == GAINS.kd_roll


def test_latched_gains_published_before_the_robot_started_are_used(operator):
    operator.create_publisher(BalanceGains, "balance_gains", LATCHED).publish(GAINS)
    robot = HumanoidNode(Humanoid())
    assert takes_the_gains(robot)
    robot.destroy_node()


def test_gains_of_a_volatile_publisher_are_used(operator):
    publisher = operator.create_publisher(BalanceGains, "balance_gains", 10)
    robot = HumanoidNode(Humanoid())
    assert takes_the_gains(robot, meanwhile=lambda: publisher.publish(GAINS))
    robot.destroy_node()
