"""The events of what the grader offers to a student's node: scripted services, scripted actions and topics.

Messages are ROS messages. `server` names who offers something, since two servers may have the same name.
"""

from __future__ import annotations

from typing import Any

from ros_runtime.record.event import Event


class ServiceOffered(Event):
    """The grader began to offer a scripted service; `server` names it, `type` is the ROS name of its type."""

    service: str
    server: str
    type: str


class ServiceWithdrawn(Event):
    """A scripted service ceased to exist, together with the requests it was working on."""

    service: str
    server: str


class RequestReceived(Event):
    """A request of the student's client reached a scripted service."""

    request: str
    service: str
    server: str
    message: Any


class ReplySent(Event):
    """A scripted service answered a request."""

    request: str
    response: Any


class MessagePublished(Event):
    """The grader published a message; `subscriptions` is the number of matched subscriptions at that time."""

    topic: str
    message: Any
    subscriptions: int


class ActionOffered(Event):
    """The grader began to offer a scripted action; `type` is the ROS name of its type."""

    action: str
    server: str
    type: str


class ActionWithdrawn(Event):
    """A scripted action ceased to exist, with its goals."""

    action: str
    server: str


class GoalReceived(Event):
    """A goal of the student's client reached a scripted action; `message` is the action's Goal."""

    goal: str
    action: str
    server: str
    message: Any


class GoalReplySent(Event):
    """A scripted action accepted or rejected a goal."""

    goal: str
    accepted: bool


class FeedbackSent(Event):
    """A scripted action published feedback for a goal."""

    goal: str
    feedback: Any


class CancelReceived(Event):
    """The student's client requested to cancel `goal`; empty: every goal."""

    cancel: str
    action: str
    server: str
    goal: str


class CancelReplySent(Event):
    """A scripted action answered a cancel; `return_code` is of action_msgs/CancelGoal, `canceling` names goals."""

    cancel: str
    return_code: int
    canceling: list[str]


class GoalFinished(Event):
    """A scripted action ended a goal; `status` is of action_msgs/GoalStatus."""

    goal: str
    status: int
    result: Any


class ResultRequested(Event):
    """The student's client requested the result of a goal."""

    goal: str


class ResultSent(Event):
    """A scripted action answered a request for a result."""

    goal: str


class ResultForgotten(Event):
    """A scripted action dropped a goal and its result after `GoalScript.kept_for`."""

    goal: str
