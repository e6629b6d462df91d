"""Publishes commands to the robot."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from geometry_msgs.msg import Twist

from lab.client import topics
from lab.client.connection import NAMESPACE, connection
from lab.client.waiting import becomes_true
from lab.errors import NoRobotError
from ros_runtime.cell_notice import notice

COMMAND_PERIOD = 0.1  # s; the robot stops by itself 0.5 s after the last command


def publish(topic: str, message: Any, *, timeout: float = 5.0) -> None:
    """Wait for a subscriber, then publish one message; a message without a subscriber would be lost.

    Raises NoRobotError when there is no subscriber within `timeout` s.
    """
    publisher = _publisher(topic, type(message))
    with notice(f"This waits up to {timeout:g} s for a node that subscribes to {topic}."):
        is_matched = becomes_true(lambda: publisher.get_subscription_count() > 0, timeout)
    if not is_matched:
        raise NoRobotError(
            f"no node has subscribed to {NAMESPACE}/{topic} with type {type(message).__name__} within {timeout:g} s. "
            "Start the robot with lab.start_robot(), and check the topic's name and type."
        )
    publisher.publish(message)


@contextmanager
def walking(forward: float = 0.0, sideways: float = 0.0, turn: float = 0.0) -> Iterator[None]:
    """Walk while the `with` block runs, then stop.

    `forward` and `sideways` are in m/s, `turn` is in rad/s; left is positive. The velocity is published on cmd_vel ten
    times a second, because the robot stops when it receives no command for 0.5 s.

    Raises NoRobotError when no robot is running.
    """
    topics.robot_state()  # raises where no robot publishes it
    command = Twist()
    command.linear.x, command.linear.y, command.angular.z = float(forward), float(sideways), float(turn)
    publish("cmd_vel", command)
    publisher, node = _publisher("cmd_vel", Twist), connection().node
    timer = node.create_timer(COMMAND_PERIOD, lambda: publisher.publish(command))
    try:
        yield
    finally:
        node.destroy_timer(timer)
        publisher.publish(Twist())


def _publisher(topic: str, message_type: Any) -> Any:
    return connection().get_or_create(
        (topic, message_type), lambda node: node.create_publisher(message_type, topic, 10)
    )
