"""A scenario takes over the robot, like an operator's remote control: meanwhile cmd_vel is ignored."""

import pytest
import rclpy
from geometry_msgs.msg import Twist

from robot_sim.humanoid import Humanoid
from robot_sim.ros.node import HumanoidNode
from robot_sim.ros.scenario_control import apply_command

AHEAD = Twist()
AHEAD.linear.x = 0.3


@pytest.fixture
def node():
    """A robot's node that is not spun; the test calls its callbacks with messages."""
    rclpy.init()
    node = HumanoidNode(Humanoid())
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def walk_on(node, duration):
    """Let the robot walk while a program publishes a forward velocity at 20 Hz; return the distance."""
    humanoid = node.humanoid
    start, end, due = humanoid.base_pose(), humanoid.time + duration, humanoid.time
    while humanoid.time < end:
        if humanoid.time >= due:
            node._on_velocity(AHEAD)
            due += 0.05
        humanoid.step()
        node.publish_due()
    now = humanoid.base_pose()
    return now.position[0] - start.position[0], now.yaw - start.yaw


def test_a_taken_over_robot_ignores_cmd_vel_until_it_is_released(node):
    assert walk_on(node, 3.0)[0] > 0.3
    apply_command({"do": "take_over", "velocity": [0.0, 0.0, 0.0]}, node.humanoid, node)
    walk_on(node, 1.5)
    assert abs(walk_on(node, 2.0)[0]) < 0.03
    apply_command({"do": "take_over", "velocity": None}, node.humanoid, node)
    assert walk_on(node, 3.0)[0] > 0.3


def test_an_operator_turns_the_robot_without_a_fall(node):
    walk_on(node, 2.0)
    apply_command({"do": "take_over", "velocity": [0.0, 0.0, 0.45]}, node.humanoid, node)
    assert walk_on(node, 2.5)[1] > 0.6
    assert node.humanoid.up() > 0.95
