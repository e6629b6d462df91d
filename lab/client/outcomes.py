"""What a notebook gets when a goal has ended or a cancel request was answered."""

from __future__ import annotations

from typing import Any, NamedTuple

from lab.client.formatting import describe
from ros_runtime.record.client_events import CancelAnswered


class Outcome(NamedTuple):
    """How a goal ended: the name of its status in action_msgs/GoalStatus, and the result message."""

    status: str
    result: Any

    def __repr__(self) -> str:
        return f"{self.status} ({describe(self.result)})"


class CancelAnswer(NamedTuple):
    """The response to a cancel request; it is accepted if `goals_canceling` contains the goal."""

    accepted: bool
    return_code: int

    def __repr__(self) -> str:
        return f"{'accepted' if self.accepted else 'not accepted'}, return_code {self.return_code}"


def read_cancel_answer(answer: CancelAnswered, goal: str) -> CancelAnswer:
    """Return the response to a cancel request for one goal; `goal` is the goal's name in the log."""
    return CancelAnswer(goal in answer.canceling, answer.return_code)
