"""Handles of an action's client: a goal it has sent, and a request to cancel."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ros_runtime.record.client_events import (
    CancelAnswered,
    FeedbackReceived,
    GoalAnswered,
    ResultReceived,
    TooLarge,
)
from ros_runtime.recorded_client.conversation import Conversation

if TYPE_CHECKING:  # which makes them
    from ros_runtime.recorded_client.action_client import ActionClient

ANSWER_TIMEOUT = 5.0  # s
RESULT_TIMEOUT = 40.0  # s


class Cancel:
    """A request to cancel on its way, or answered."""

    def __init__(self, name: str, conversation: Conversation) -> None:
        self.name = name
        self._conversation = conversation

    @property
    def answer(self) -> CancelAnswered | None:
        """The answer; None before it comes."""
        return self._conversation.log.first(CancelAnswered, cancel=self.name)

    def wait(self, timeout: float = ANSWER_TIMEOUT) -> bool:
        """Wait for the answer; return whether it came."""
        conversation = self._conversation
        return conversation.wait(
            "cancel",
            self.name,
            lambda: conversation.has_come(CancelAnswered, "cancel answer", cancel=self.name),
            timeout,
        )


class Goal:
    """A goal that was sent."""

    def __init__(self, name: str, id: bytes, client: ActionClient, conversation: Conversation) -> None:
        self.name = name
        self.id = id
        self._client = client
        self._conversation = conversation
        self._log = conversation.log

    @property
    def accepted(self) -> bool | None:
        """Whether the server accepted it; None before its answer."""
        answer = self._log.first(GoalAnswered, goal=self.name)
        return answer.accepted if answer else None

    @property
    def feedback(self) -> Sequence[Any]:
        """The feedback messages so far."""
        return [event.feedback for event in self._log.all(FeedbackReceived, goal=self.name)]

    @property
    def result(self) -> ResultReceived | None:
        """Status and result message; None before they come."""
        return self._log.first(ResultReceived, goal=self.name)

    @property
    def has_ended(self) -> bool:
        """Whether its result came, readable or not."""
        return self._conversation.has_come(ResultReceived, "result", goal=self.name)

    def wait_for_answer(self, timeout: float = ANSWER_TIMEOUT) -> bool:
        """Wait until it is accepted or rejected; return whether it is either."""
        return self._conversation.wait("goal", self.name, lambda: self.accepted is not None, timeout)

    def wait_for_feedback(self, count: int = 1, timeout: float = RESULT_TIMEOUT) -> bool:
        """Wait for `count` feedback messages; return False if the goal or the time ends first."""

        def is_enough() -> bool:
            too_large = self._log.count(TooLarge, what="feedback", id=self.name)
            return self._log.count(FeedbackReceived, goal=self.name) + too_large >= count

        self._log.wait_until(
            lambda: is_enough() or self.has_ended or self._conversation.is_in_vain(), timeout
        )
        return is_enough()

    def wait_for_result(self, timeout: float = RESULT_TIMEOUT) -> bool:
        """Wait for the end of the goal; return at once if it was not accepted."""
        if not self.accepted:
            return False
        return self._conversation.wait("result", self.name, lambda: self.has_ended, timeout)

    def cancel(self, *, by: str = "client") -> Cancel:
        """Ask to cancel it, without waiting; `by` is the name of the client that asks."""
        return self._client.ask_to_cancel(self.name, self.id, by)
