"""The events of a client of services and actions: requests and what comes back. Messages are ROS messages.

Each request, goal and cancel request has a name, by which its answer, feedback and result are found.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from ros_runtime.record.event import Event


@dataclass(frozen=True, kw_only=True)
class ServiceCalled(Event):
    """A request was sent."""

    call: str
    service: str
    request: Any


@dataclass(frozen=True, kw_only=True)
class ServiceAnswered(Event):
    """Its response came."""

    call: str
    response: Any


@dataclass(frozen=True, kw_only=True)
class GoalSent(Event):
    """A goal was sent; `request` is the action's Goal."""

    goal: str
    action: str
    request: Any


@dataclass(frozen=True, kw_only=True)
class GoalAnswered(Event):
    """The server accepted or rejected a goal."""

    goal: str
    accepted: bool


@dataclass(frozen=True, kw_only=True)
class FeedbackReceived(Event):
    """The server published feedback for a goal."""

    goal: str
    feedback: Any


@dataclass(frozen=True, kw_only=True)
class StatusSeen(Event):
    """The goal's status on the action's status topic changed (action_msgs/GoalStatus)."""

    goal: str
    status: int


@dataclass(frozen=True, kw_only=True)
class CancelSent(Event):
    """`by` is the client that asked; `goal` is empty when it asked to cancel every goal."""

    cancel: str
    goal: str
    by: str


@dataclass(frozen=True, kw_only=True)
class CancelAnswered(Event):
    """`canceling` names the goals that the server agreed to cancel; `return_code` is of action_msgs/CancelGoal."""

    cancel: str
    return_code: int
    canceling: list[str]


@dataclass(frozen=True, kw_only=True)
class ResultReceived(Event):
    """A goal ended; `status` is of action_msgs/GoalStatus."""

    goal: str
    status: int
    result: Any


@dataclass(frozen=True, kw_only=True)
class TooLarge(Event):
    """A message of a student's program ("answer", "feedback", …) had more `bytes` than the `limit`, and was not read.

    `id` names the call, goal or cancel request it belongs to, if any.
    """

    what: str
    id: str
    bytes: int
    limit: int


@dataclass(frozen=True, kw_only=True)
class Unanswered(Event):
    """The client stopped waiting, after `waited` s, for the answer to a call, goal, cancel or result, or for an end."""

    what: Literal["call", "goal", "cancel", "result", "end"]
    id: str
    waited: float
