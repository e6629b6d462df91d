"""The live graph, listed and drawn."""

from __future__ import annotations

import pytest
from kernels import CellError, Kernel

SUBSCRIBES = """
from sensor_msgs.msg import Imu
from rclpy.qos import qos_profile_sensor_data
asks_too_much = lab.node().create_subscription(Imu, "imu", print, 10)
"""


@pytest.fixture(scope="module")
def robot(kernel: Kernel) -> Kernel:
    kernel.run("lab.start_robot()")
    kernel.run(SUBSCRIBES)
    kernel.run(
        "lab.wait_until(lambda: '/robot/imu' in [topic.name for topic in lab.client.graph.topics_in_graph()])"
    )
    return kernel


def test_the_nodes_have_their_full_names(robot: Kernel) -> None:
    assert robot.run("print(lab.nodes_in_graph())") == "['/robot/humanoid', '/robot/notebook']\n"


def test_a_topic_is_listed_with_its_ends_and_their_qos(robot: Kernel) -> None:
    assert robot.run("lab.list_graph('robot_state')").splitlines() == [
        "/robot/robot_state  humanoid_interfaces/msg/RobotState",
        "    from /robot/humanoid: reliable, transient local",
        "    to   /robot/notebook: reliable, transient local",
    ]


def test_a_subscription_that_requests_too_much_is_marked(robot: Kernel) -> None:
    assert robot.run("lab.list_graph('imu')").splitlines() == [
        "/robot/imu  sensor_msgs/msg/Imu",
        "    from /robot/humanoid: best effort",
        "    to   /robot/notebook: reliable",
        "         receives nothing from /robot/humanoid, which offers only best effort",
    ]


def test_all_topics_are_listed_but_those_of_every_node(robot: Kernel) -> None:
    listed = robot.run("lab.list_graph()")
    assert "/robot/odom  nav_msgs/msg/Odometry" in listed
    assert "/sim/push" in listed
    assert "/rosout" not in listed


def test_the_text_alternative_names_publishers_and_subscribers(robot: Kernel) -> None:
    svg = robot.run("print(lab.draw_graph('imu', 'odom', 'cmd_vel', title='A & B').data)")
    assert "<title>A &amp; B</title>" in svg
    assert "/robot/imu: from /robot/humanoid to /robot/notebook (which receives nothing)." in svg
    assert "/robot/odom: from /robot/humanoid to /robot/notebook." in svg
    assert "/robot/cmd_vel: from nobody to /robot/humanoid." in svg
    assert svg.count('stroke="#c0392b"') == 2  # a line, and its legend
    width = int(svg.partition(' width="')[2].partition('"')[0])
    assert width <= 600  # px; in a wider drawing the letters shrink beside the robot's panel


def test_an_absolute_name_is_another_topic(robot: Kernel) -> None:
    with pytest.raises(
        CellError, match=r"no node publishes or subscribes to /odom; the topics are: .*/robot/odom"
    ):
        robot.run("lab.draw_graph('/odom')")
