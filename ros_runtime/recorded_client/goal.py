"""Handles of an action client: for a goal and for a cancel request that it has sent."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from ros_runtime.message_constants import GoalStatus
from ros_runtime.record.client_events import (
    CancelAnswered,
    FeedbackReceived,
    GoalAnswered,
    ResultReceived,
    StatusSeen,
    TooLarge,
)
from ros_runtime.record.event import Event
from ros_runtime.recorded_client.conversation import DEFAULT_CLIENT, Conversation, Request

ANSWER_TIMEOUT = 5.0  # s
RESULT_TIMEOUT = 40.0  # s


class Cancel:
    """A cancel request that was sent.

    Attributes:
        answer: the server's answer; None before it arrives.
    """

    request: Request

    def __init__(self, name: str, conversation: Conversation) -> None:
        self.name = name
        self.answer: CancelAnswered | None = None
        self._conversation = conversation

    def wait(self, timeout: float = ANSWER_TIMEOUT) -> bool:
        """Wait for the answer; return whether it came."""
        return self._conversation.wait("cancel", self.name, self._is_answered, timeout)

    def _is_answered(self) -> bool:
        return self.answer is not None or self._conversation.was_too_large("cancel answer", self.name)


# takes a goal's name and id, and the name of the sending client
SendCancel = Callable[[str, bytes, str], Cancel]


class Goal:
    """A goal that was sent, with its answer, status, feedback and result so far.

    Attributes:
        request: the send_goal request.
        sent_at: s, on the monotonic clock.
        accepted: whether the server accepted it; None before its answer.
        status: the last status that was published or returned with the result (action_msgs/GoalStatus).
        feedback: the feedback messages so far.
        result: status and result message; None before the result arrives.
        listeners: called after each event of the goal, on the thread that spins the node.
    """

    request: Request

    def __init__(self, name: str, id: bytes, conversation: Conversation, send_cancel: SendCancel) -> None:
        self.name = name
        self.id = id
        self.sent_at = time.monotonic()
        self.accepted: bool | None = None
        self.status: int = GoalStatus.UNKNOWN
        self.feedback: list[Any] = []
        self.result: ResultReceived | None = None
        self.listeners: list[Callable[[], object]] = []
        self._send_cancel = send_cancel
        self._conversation = conversation

    @property
    def has_ended(self) -> bool:
        """Whether the result was received, even if it was too large to be read."""
        return self.result is not None or self._conversation.was_too_large("result", self.name)

    def update(self, event: Event) -> None:
        """Update the goal with a received event."""
        match event:
            case GoalAnswered(accepted=accepted):
                self.accepted = accepted
                if accepted:  # the status topic may already have published a later status
                    self.status = max(self.status, GoalStatus.ACCEPTED)
            case FeedbackReceived(feedback=feedback):
                self.feedback.append(feedback)
            case StatusSeen(status=status):
                self.status = status
            case ResultReceived(status=status):
                self.result, self.status = event, status

    def wait_for_answer(self, timeout: float = ANSWER_TIMEOUT) -> bool:
        """Wait until the goal is accepted or rejected; return whether that happened in time."""
        return self._conversation.wait("goal", self.name, lambda: self.accepted is not None, timeout)

    def wait_for_feedback(self, count: int = 1, timeout: float = RESULT_TIMEOUT) -> bool:
        """Wait for `count` feedback messages; return False if the goal ends or `timeout` s pass first."""

        def is_enough() -> bool:
            too_large = self._conversation.log.count(TooLarge, what="feedback", id=self.name)
            return len(self.feedback) + too_large >= count

        self._conversation.log.wait_until(
            lambda: is_enough() or self.has_ended or self._conversation.server_is_gone(), timeout
        )
        return is_enough()

    def wait_for_result(self, timeout: float = RESULT_TIMEOUT) -> bool:
        """Wait for the result; return whether it came. Return False at once if the goal was not accepted."""
        if not self.accepted:
            return False
        return self._conversation.wait("result", self.name, lambda: self.has_ended, timeout)

    def cancel(self, *, by: str = DEFAULT_CLIENT) -> Cancel:
        """Request to cancel the goal, without waiting; `by` is the name of the client that sends the request."""
        return self._send_cancel(self.name, self.id, by)
