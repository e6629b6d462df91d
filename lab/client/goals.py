"""Sends goals to action servers, receives feedback and results, and cancels goals."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

from lab.client.connection import connection
from lab.client.exchange import TIME_TO_END, give_up, no_answer, require_server
from lab.client.formatting import describe
from lab.client.interaction_log import conversation, log
from lab.client.outcomes import CancelAnswer, Outcome, read_cancel_answer
from lab.errors import LabError
from lab.running.node_diagnosis import all_have_failed, why_aborted, why_unfinished
from lab.running.student_nodes import started_nodes
from ros_runtime.cell_notice import notice
from ros_runtime.message_constants import GoalStatus, name_of
from ros_runtime.record.client_events import ResultReceived, Unanswered
from ros_runtime.recorded_client.action_client import ActionClient
from ros_runtime.recorded_client.goal import Goal as SentGoal


def send_goal(action: str, action_type: Any, goal: Any, *, timeout: float = 5.0) -> Goal:
    """Send a goal and wait until the server has accepted or rejected it.

    Args:
        action: its name, relative to the robot's namespace.
        action_type: such as `humanoid_interfaces.action.WalkTo`.
        goal: an `action_type.Goal`.
        timeout: s, once for finding the server and once more for its goal response.

    Raises:
        NoServerError: no node offers the action.
        NoAnswerError: the server has neither accepted nor rejected the goal in time.
    """
    if not isinstance(goal, action_type.Goal):
        wanted = f"{action_type.__name__}.Goal"
        raise LabError(f"the goal is a {type(goal).__name__}; {action} takes a {wanted}(…)")
    here = connection()
    client = here.get_or_create(
        ("action", action, action_type), lambda node: ActionClient(node, action, action_type, conversation)
    )
    require_server(lambda: not client.unmatched(here.node.count_publishers), action, action_type, timeout)
    sent = client.send(goal)
    with notice(f"This waits up to {timeout:g} s until {action} accepts or rejects the goal."):
        is_answered = sent.wait_for_answer(timeout)
    if not is_answered:
        raise give_up(
            sent,
            timeout,
            action,
            f"{action} has neither accepted nor rejected the goal within {timeout:g} s.",
        )
    return Goal(action, sent)


class Goal:
    """A goal that an action server has accepted or rejected."""

    def __init__(self, action: str, sent: SentGoal) -> None:
        self._action = action
        self._sent = sent

    @property
    def accepted(self) -> bool:
        """Whether the server accepted the goal; a rejected goal has no status and no result."""
        return bool(self._sent.accepted)

    @property
    def feedback(self) -> list[Any]:
        """The feedback messages that have arrived so far."""
        return self._sent.feedback

    @property
    def status(self) -> str:
        """The name of the goal's last known status, from the status topic or from the result."""
        return name_of(GoalStatus, self._sent.status)

    @property
    def is_over(self) -> bool:
        """Whether the result has arrived, or the goal was rejected and will have no result."""
        return not self.accepted or self._sent.has_ended

    def result(self, timeout: float = 60.0, *, show_feedback: bool = True) -> Outcome:
        """Wait until the goal has ended and return its status and result; print feedback at most once a second.

        Raises:
            NoAnswerError: the goal has not ended in time; it stays active, and you may call this again. Or the server
                has ended.
        """
        if not self.accepted:
            raise LabError(f"{self._action} rejected this goal, so it has no result")
        with notice(f"This waits up to {timeout:g} s for the result of {self._action}."):
            received = self._await_result(timeout, show_feedback)
        outcome = Outcome(name_of(GoalStatus, received.status), received.result)
        if outcome.status == "ABORTED" and (
            why := why_aborted(started_nodes(), self._action, self._sent.name)
        ):
            print(why)
        return outcome

    def _await_result(self, timeout: float, show_feedback: bool) -> ResultReceived:
        began = time.monotonic()
        while not self._sent.result:
            waited = time.monotonic() - began
            if waited >= timeout or (waited > TIME_TO_END and all_have_failed(started_nodes())):
                waited = min(timeout, math.ceil(waited))
                log.append(Unanswered(what="result", id=self._sent.name, waited=waited))
                raise no_answer(
                    self._action,
                    f"no result from {self._action} within {waited:g} s; the goal's status is {self.status}. "
                    "Call result() again to wait longer, or cancel().",
                    lambda server: why_unfinished(server, self._sent.name),
                )
            count = len(self.feedback)
            log.wait_until(lambda: self.is_over, min(1.0, timeout - waited))
            if show_feedback and len(self.feedback) > count:
                since = time.monotonic() - self._sent.sent_at
                print(f"{since:5.1f} s  feedback: {describe(self.feedback[-1])}")
        return self._sent.result

    def cancel(self, timeout: float = 5.0) -> CancelAnswer:
        """Send a cancel request for this goal and return the response. An accepted cancel does not end the goal yet.

        Raises:
            NoAnswerError: the server has not answered in time.
        """
        request = self._sent.cancel()
        with notice(
            f"This waits up to {timeout:g} s for the answer of {self._action} to the cancel request."
        ):
            request.wait(timeout)
        if request.answer is None:
            raise give_up(
                request,
                timeout,
                self._action,
                f"{self._action} has not answered the cancel request within {timeout:g} s.",
            )
        return read_cancel_answer(request.answer, self._sent.name)

    def on_change(self, listener: Callable[[Goal], object]) -> None:
        """Call `listener(goal)` on a thread of the lab after each feedback, each change of status, and the result."""
        self._sent.listeners.append(lambda: listener(self))

    def __repr__(self) -> str:
        state = self.status if self.accepted else "rejected"
        return f"<goal of {self._action}: {state}, {len(self.feedback)} feedback messages>"
