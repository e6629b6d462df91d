"""The topics of a scenario: those of the student's node, which the grader records, and those that it publishes."""

from __future__ import annotations

from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.bounded_reading import BoundedReading

RECORDED_DEPTH, SCRIPTED_DEPTH = 100, 10


class RecordedTopic:
    """Records the messages of one topic.

    `latched` subscribes with durability transient local: it also receives the last message published before, and does
    not match a volatile publisher. `as_` is the name in the record, by default the topic's.
    """

    def __init__(
        self, node: Node, message_type: Any, name: str, log: ArenaLog, *, latched: bool, as_: str = ""
    ) -> None:
        self.name = as_ or name
        self._type = message_type
        self._log = log
        self._reading = BoundedReading(log)
        self._latest: Any = None
        durability = DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE
        profile = QoSProfile(depth=RECORDED_DEPTH, durability=durability)
        self._subscription = node.create_subscription(message_type, name, self._on_message, profile, raw=True)

    @property
    def messages(self) -> int:
        """The number of messages received."""
        return self._log.count(ev.MessageReceived, topic=self.name)

    @property
    def latest(self) -> Any:
        """The last message received; None before the first."""
        return self._latest

    @property
    def publishers(self) -> int:
        """The number of matched publishers."""
        return self._subscription.get_publisher_count()

    def _on_message(self, data: bytes) -> None:
        if not self._reading.admits(ev.MessageReceived.kind, self.name):
            return
        message = self._reading.unpack("message", self.name, data, self._type)
        if message is not None:
            self._latest = message
            self._log.append(ev.MessageReceived(topic=self.name, message=message))


class ScriptedTopic:
    """Publishes one topic, reliably; `latched` keeps the last message for subscriptions that come later."""

    def __init__(self, node: Node, message_type: Any, name: str, log: ArenaLog, *, latched: bool) -> None:
        self.name = name
        self._log = log
        profile = (
            QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL) if latched else SCRIPTED_DEPTH
        )
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
