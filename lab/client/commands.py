"""Commands to the robot by topic."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from geometry_msgs.msg import Twist

from lab.client.connection import NAMESPACE, connection
from lab.client.waiting import comes_true
from lab.errors import NoRobotError

COMMAND_PERIOD = 0.1  # s; the robot stops by itself 0.5 s after the last command


def publish(topic: str, message: Any, *, timeout: float = 5.0) -> None:
    """Wait for a subscriber, then publish one message; without a subscriber it would be lost.

    Raises NoRobotError when there is no subscriber within `timeout` s.
    """
    publisher = _publisher(topic, type(message))
    if not comes_true(lambda: publisher.get_subscription_count() > 0, timeout):
        raise NoRobotError(
            f"nobody subscribes to {NAMESPACE}/{topic} ({type(message).__name__}) after {timeout:g} s; "
            "is the robot up (lab.start_robot()), and is that the topic's type?"
        )
    publisher.publish(message)


@contextmanager
def walking(forward: float = 0.0, sideways: float = 0.0, turn: float = 0.0) -> Iterator[None]:
    """Walk as long as the `with` block lasts, then stop: m/s, m/s (left is positive), rad/s (left is positive).

    It publishes cmd_vel ten times a second, because the robot stops when it receives nothing for 0.5 s.
    """
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
    return connection().once(
        (topic, message_type), lambda node: node.create_publisher(message_type, topic, 10)
    )
