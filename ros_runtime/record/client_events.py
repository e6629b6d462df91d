"""The events of a client of services and actions: what it sends and what it receives. Messages are ROS messages.

Each request, goal and cancel request has a name. The events of its answer, feedback and result carry the same name.
"""

from __future__ import annotations

from typing import Any, Literal

from ros_runtime.record.event import Event


class ServiceCalled(Event):
    """A request was sent."""

    call: str
    service: str
    request: Any


class ServiceAnswered(Event):
    """The response to a request was received."""

    call: str
    response: Any


class GoalSent(Event):
    """A goal was sent; `request` is the action's Goal."""

    goal: str
    action: str
    request: Any


class GoalAnswered(Event):
    """The server accepted or rejected a goal."""

    goal: str
    accepted: bool


class FeedbackReceived(Event):
    """The server published feedback for a goal."""

    goal: str
    feedback: Any


class StatusSeen(Event):
    """The goal's status on the action's status topic changed (action_msgs/GoalStatus)."""

    goal: str
    status: int


class CancelSent(Event):
    """The client `by` sent a cancel request; an empty `goal` means that it requested to cancel every goal."""

    cancel: str
    goal: str
    by: str


class CancelAnswered(Event):
    """The server answered a cancel request; `canceling` names the goals that it agreed to cancel.

    `return_code` is a constant of action_msgs/CancelGoal.
    """

    cancel: str
    return_code: int
    canceling: list[str]


class ResultReceived(Event):
    """A goal ended and its result was received; `status` is a constant of action_msgs/GoalStatus."""

    goal: str
    status: int
    result: Any


class TooLarge(Event):
    """A message of a student's program had more `bytes` than the `limit`, and was not read.

    `what` is "answer", "feedback" and so on; `id` names the call, goal or cancel request of the message, if any.
    """

    what: str
    id: str
    bytes: int
    limit: int


class Unanswered(Event):
    """After `waited` s the client stopped waiting: for an answer, for a result, or for the end of a program."""

    what: Literal["call", "goal", "cancel", "result", "end"]
    id: str
    waited: float
