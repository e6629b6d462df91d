"""The messages of one subscription; any node may publish anything on its topic.

Bytes are checked before they are deserialized, and the number of messages and bytes a second is limited. Messages that
are too large are refused, and those beyond the limit have to wait, so that no node can delay the robot.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.serialization import deserialize_message
from rclpy.subscription import Subscription

from ros_runtime.record.ground_truth import RobotRefused

LARGEST_FIXED_SIZE = 64  # bytes, more than any message of fixed length that the robot subscribes to
MESSAGES_A_SECOND = 200  # per second of simulated time; after a pause, as many are accepted at once
# Per second of simulated time. The largest trajectory is a little smaller; it takes 10 ms of processor time.
BYTES_A_SECOND = 400_000
REPORT_PERIOD = 0.25  # s of simulated time between two reports on a topic

FLOOD = f"more than {MESSAGES_A_SECOND} messages or {BYTES_A_SECOND} bytes a second"


class Inbox:
    """A filter between a subscription and its callback that refuses malformed, too large and too many messages.

    Args:
        subscription: whose callback is called with each message.
        report: is called about refused messages and floods, at most every `REPORT_PERIOD`; for a flood, the count is
            how often the limit was reached and the next messages had to wait.
        most_bytes: longer messages are refused.
        why_not: returns why a message with these bytes is refused, or ""; a ValueError means that they are malformed.
    """

    def __init__(
        self,
        subscription: Subscription,
        report: Callable[[RobotRefused], object] | None = None,
        *,
        most_bytes: int = LARGEST_FIXED_SIZE,
        why_not: Callable[[bytes], str] = lambda _: "",
    ) -> None:
        self.topic: str = subscription.topic_name
        self._subscription = subscription
        self._report = report
        self._most_bytes = most_bytes
        self._why_not = why_not
        self._tally: dict[str, _Tally] = {}
        self._messages = float(MESSAGES_A_SECOND)  # number that may still be taken now
        self._bytes = float(BYTES_A_SECOND)  # number that may still be taken now
        self._latest = 0.0
        self._next_report = 0.0

    def process_arrived(self, now: float) -> None:
        """Process the messages that arrived by simulated time `now` (s), up to the limit; others wait in the queue."""
        if now < self._latest:  # as at a reset
            self._latest = self._next_report = now
        passed, self._latest = now - self._latest, now
        self._messages = min(MESSAGES_A_SECOND, self._messages + passed * MESSAGES_A_SECOND)
        self._bytes = min(BYTES_A_SECOND, self._bytes + passed * BYTES_A_SECOND)
        handle, kind = self._subscription.handle, self._subscription.msg_type
        while self._may_take() and (taken := handle.take_message(kind, True)):
            self.process(taken[0])
        if self._tally and now >= self._next_report:
            self.report()
            self._next_report = now + REPORT_PERIOD

    def process(self, data: bytes) -> None:
        """Deserialize one message and pass it to the callback, unless it is refused."""
        self._messages -= 1
        self._bytes = max(-BYTES_A_SECOND, self._bytes - len(data))
        reason, message = self._open(data)
        if message is not None:
            self._subscription.callback(message)
            reason = "" if self._may_take() else FLOOD
        if reason:
            self._count(reason, len(data))

    def report(self) -> None:
        """Report what has not been reported yet."""
        for reason, tally in self._tally.items():
            if tally.is_unreported and self._report:
                sizes = {"count": tally.count, "bytes": tally.largest, "limit": self._most_bytes}
                self._report(RobotRefused(topic=self.topic, reason=reason, **sizes))
            tally.is_unreported = False

    def _may_take(self) -> bool:
        return self._messages >= 1 and self._bytes > 0

    def _open(self, data: bytes) -> tuple[str, Any]:
        """Return why a message is refused, or "" and the message."""
        if len(data) > self._most_bytes:
            return f"more than {self._most_bytes} bytes", None
        try:
            reason = self._why_not(data)
            return reason, None if reason else deserialize_message(data, self._subscription.msg_type)
        except Exception:  # the exception's type depends on the middleware
            return "malformed", None

    def _count(self, reason: str, size: int) -> None:
        tally = self._tally.setdefault(reason, _Tally())
        tally.count += 1
        tally.largest = max(tally.largest, size)
        tally.is_unreported = True


class _Tally:
    """The number of messages with one reason, the bytes of the largest, and whether the report of it is still due."""

    def __init__(self) -> None:
        self.count = self.largest = 0
        self.is_unreported = False
