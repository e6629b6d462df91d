"""Send a goal to an action server, follow it, cancel it."""

from __future__ import annotations

import time
import uuid
from collections.abc import Callable
from typing import Any, NamedTuple

from action_msgs.srv import CancelGoal
from unique_identifier_msgs.msg import UUID

from lab import interaction_log
from lab.action_endpoints import ActionEndpoints
from lab.connection import connection
from lab.errors import LabError, NoAnswerError
from lab.exchange import Exchange, require_server
from lab.formatting import describe, describe_briefly
from lab.student_nodes import output_of_failed_nodes
from lab.waiting import comes_true
from ros_runtime.message_constants import GoalStatus, name_of


class Outcome(NamedTuple):
    """How a goal ended: the name of its status in action_msgs/GoalStatus, and the result message."""

    status: str
    result: Any

    def __repr__(self) -> str:
        return f"{self.status} ({describe(self.result)})"


class CancelAnswer(NamedTuple):
    """The answer to a cancel request; `accepted` if the server lists the goal in `goals_canceling`."""

    accepted: bool
    return_code: int

    def __repr__(self) -> str:
        return f"{'accepted' if self.accepted else 'not accepted'}, return_code {self.return_code}"


def send_goal(action: str, action_type: Any, goal: Any, *, timeout: float = 5.0) -> Goal:
    """Send a goal and wait until the server has accepted or rejected it.

    Args:
        action: its name, relative to the robot's namespace.
        action_type: such as `humanoid_interfaces.action.WalkTo`.
        goal: an `action_type.Goal`.
        timeout: s, for finding the server and for its answer, each.

    Raises:
        NoServerError: nobody offers the action.
        NoAnswerError: the server has neither accepted nor rejected in time.
    """
    if not isinstance(goal, action_type.Goal):
        wanted = f"{action_type.__name__}.Goal"
        raise LabError(f"the goal is a {type(goal).__name__}; {action} takes a {wanted}(…)")
    endpoints = connection().once(
        ("action", action, action_type), lambda node: ActionEndpoints(node, action, action_type)
    )
    require_server(endpoints.are_matched, action, action_type, timeout)
    return Goal(endpoints, goal, timeout)


class Goal:
    """A goal that was sent to an action server.

    Attributes:
        accepted: whether the server accepted it; a rejected goal has no status and no result.
        feedback: the feedback messages so far.
    """

    def __init__(self, endpoints: ActionEndpoints, goal: Any, timeout: float) -> None:
        self._endpoints = endpoints
        self.id = uuid.uuid4().bytes
        self.feedback: list[Any] = []
        self._status: int = GoalStatus.UNKNOWN
        self._listeners: list[Callable[[Goal], object]] = []
        self._getting_result: Exchange | None = None
        self._sent_at = time.monotonic()
        endpoints.goals[self.id] = self
        request = endpoints.types.SendGoalService.Request(goal_id=UUID(uuid=list(self.id)), goal=goal)
        sending = endpoints.ask(
            "send_goal",
            request,
            f"send_goal: {describe_briefly(goal)}",
            lambda answer: "goal accepted" if answer.accepted else "goal rejected",
            self._on_goal_answer,
        )
        if not sending.wait(timeout):
            sending.give_up(timeout)
            raise NoAnswerError(
                f"{endpoints.name} has neither accepted nor rejected the goal within {timeout:g} s. "
                f"Is its goal callback or its only thread busy?{output_of_failed_nodes()}"
            )
        self.accepted: bool = sending.answer.accepted

    @property
    def status(self) -> str:
        """The name of its status, as last published on the status topic or returned with the result."""
        return name_of(GoalStatus, self._status)

    @property
    def is_over(self) -> bool:
        """Whether the result has arrived, or will not because the goal was rejected."""
        return not self.accepted or (
            self._getting_result is not None and self._getting_result.answer is not None
        )

    def result(self, timeout: float = 60.0, *, show_feedback: bool = True) -> Outcome:
        """Wait until the goal has ended and return status and result. Prints feedback, at most once a second.

        Raises:
            NoAnswerError: the goal has not ended in time; it continues, and you may call this again.
        """
        if not self.accepted:
            raise LabError(f"{self._endpoints.name} rejected this goal, so it has no result")
        deadline = time.monotonic() + timeout
        while not self.is_over:
            if time.monotonic() >= deadline:
                raise self._no_result(timeout)
            count = len(self.feedback)
            comes_true(lambda: self.is_over, min(1.0, deadline - time.monotonic()))
            if show_feedback and len(self.feedback) > count:
                print(f"{time.monotonic() - self._sent_at:5.1f} s  feedback: {describe(self.feedback[-1])}")
        assert self._getting_result
        response = self._getting_result.answer
        return Outcome(name_of(GoalStatus, response.status), response.result)

    def cancel(self, timeout: float = 5.0) -> CancelAnswer:
        """Ask the server to cancel this goal and return its answer. Accepting a cancel does not end the goal yet.

        Raises:
            NoAnswerError: the server has not answered in time.
        """
        request = CancelGoal.Request()
        request.goal_info.goal_id.uuid = list(self.id)
        asking = self._endpoints.ask(
            "cancel_goal", request, "cancel_goal", lambda answer: f"cancel {self._read(answer)}"
        )
        if not asking.wait(timeout):
            asking.give_up(timeout)
            raise NoAnswerError(
                f"{self._endpoints.name} has not answered the request to cancel within {timeout:g} s: "
                f"a server whose only thread is busy cannot.{output_of_failed_nodes()}"
            )
        return self._read(asking.answer)

    def on_change(self, listener: Callable[[Goal], object]) -> None:
        """Call `listener(goal)` after each feedback, each change of status and the result, on a thread of the lab."""
        self._listeners.append(listener)

    def __repr__(self) -> str:
        state = self.status if self.accepted else "rejected"
        return f"<goal of {self._endpoints.name}: {state}, {len(self.feedback)} feedback messages>"

    def _read(self, answer: Any) -> CancelAnswer:
        canceling = any(bytes(bytearray(info.goal_id.uuid)) == self.id for info in answer.goals_canceling)
        return CancelAnswer(canceling, answer.return_code)

    def _no_result(self, timeout: float) -> NoAnswerError:
        assert self._getting_result
        interaction_log.end(self._getting_result)
        return NoAnswerError(
            f"no result from {self._endpoints.name} within {timeout:g} s; the goal's status is {self.status}. "
            f"Call result() again to wait longer, or cancel().{output_of_failed_nodes()}"
        )

    def _on_goal_answer(self, answer: Any) -> None:
        if answer.accepted:
            self._status = max(self._status, GoalStatus.ACCEPTED)  # the topic may have been faster
            request = self._endpoints.types.GetResultService.Request(goal_id=UUID(uuid=list(self.id)))
            self._getting_result = self._endpoints.ask(
                "get_result",
                request,
                "get_result",
                lambda answer: f"{name_of(GoalStatus, answer.status)}, {describe_briefly(answer.result)}",
                lambda answer: self.note_status(answer.status, published=False),
            )

    def note_feedback(self, feedback: Any) -> None:
        """Take a feedback message that the server published."""
        self.feedback.append(feedback)
        self._endpoints.record(f"feedback: {describe_briefly(feedback)}", repeats=True)
        self._notify_listeners()

    def note_status(self, status: int, *, published: bool = True) -> None:
        """Take a status that the server published or returned with the result."""
        if status != self._status:
            self._status = status
            if published:
                self._endpoints.record(f"status: {name_of(GoalStatus, status)}")
            self._notify_listeners()

    def _notify_listeners(self) -> None:
        for listener in self._listeners:
            listener(self)
