"""A topic that the grader publishes for a student's node."""

from __future__ import annotations

from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog

DEPTH = 10


class ScriptedTopic:
    """Publishes one topic, reliably; `latched` keeps the last message for subscriptions that come later."""

    def __init__(self, node: Node, message_type: Any, name: str, log: ArenaLog, *, latched: bool) -> None:
        self.name = name
        self._log = log
        profile = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL) if latched else DEPTH
        self._publisher = node.create_publisher(message_type, name, profile)

    @property
    def subscriptions(self) -> int:
        """The number of subscriptions that it is matched with."""
        return self._publisher.get_subscription_count()

    def publish(self, message: Any) -> None:
        """Publish a message."""
        event = ev.MessagePublished(topic=self.name, message=message, subscriptions=self.subscriptions)
        self._log.append(event)
        self._publisher.publish(message)
