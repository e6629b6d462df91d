"""Turns a notebook's events into arrows of a sequence diagram, and into labels on a time axis."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from lab.client.formatting import describe_briefly
from lab.client.outcomes import read_cancel_answer
from ros_runtime.drawing.sequence_diagram import Arrow
from ros_runtime.message_constants import GoalStatus, RobotMode, name_of
from ros_runtime.record.client_events import (
    CancelAnswered,
    CancelSent,
    FeedbackReceived,
    GoalAnswered,
    GoalSent,
    ResultReceived,
    ServiceAnswered,
    ServiceCalled,
    StatusSeen,
)
from ros_runtime.record.event import Event

NOTEBOOK, ROBOT = "notebook", "robot"


class ModeChanged(Event):
    """The mode that the robot publishes has changed; `mode` is a constant of humanoid_interfaces/RobotState."""

    mode: int


class GaveUp(Event):
    """The notebook received no answer to a request within `timeout` s."""

    timeout: float


@dataclass(frozen=True)
class Message(Arrow):
    """An arrow; `repeats` means that it belongs to a stream, of which the diagram shows the first and the last one."""

    repeats: bool = False


class Messages:
    """Turns events into labelled arrows; remembers each goal's last status and each cancel request's goal."""

    def __init__(self) -> None:
        self._statuses: dict[str, int] = {}
        self._cancels: dict[str, str] = {}

    def of(self, event: Event) -> Iterator[Message]:
        """Yield the arrows for an event."""
        t = event.t
        match event:
            case ServiceCalled(call=call, service=service, request=request):
                content = describe_briefly(request)
                yield _request(t, call, service if content == "empty" else f"{service}: {content}")
            case ServiceAnswered(call=call, response=response):
                yield _answer(t, call, describe_briefly(response))
            case GoalSent(goal=goal, request=request):
                yield _request(t, goal, f"send_goal: {describe_briefly(request)}")
            case GoalAnswered(goal=goal, accepted=False):
                yield _answer(t, goal, "goal rejected")
            case GoalAnswered(goal=goal):
                self._has_changed(goal, max(self._statuses.get(goal, 0), GoalStatus.ACCEPTED))
                yield _answer(t, goal, "goal accepted")
                yield _request(t, goal, "get_result")
            case FeedbackReceived(goal=goal, feedback=feedback):
                yield _published(t, goal, f"feedback: {describe_briefly(feedback)}", repeats=True)
            case StatusSeen(goal=goal, status=status) if self._has_changed(goal, status):
                yield _published(t, goal, f"status: {name_of(GoalStatus, status)}")
            case CancelSent(cancel=cancel, goal=goal):
                self._cancels[cancel] = goal
                yield _request(t, goal, "cancel_goal")
            case CancelAnswered(cancel=cancel):
                goal = self._cancels.pop(cancel)
                yield _answer(t, goal, f"cancel {read_cancel_answer(event, goal)}")
            case ResultReceived(goal=goal, status=status, result=result):
                self._has_changed(goal, status)
                yield _answer(t, goal, f"{name_of(GoalStatus, status)}, {describe_briefly(result)}")
            case ModeChanged(mode=mode):
                yield Message(t, ROBOT, ROBOT, name_of(RobotMode, mode))
            case GaveUp(timeout=timeout):
                yield Message(t, NOTEBOOK, NOTEBOOK, f"no answer after {timeout:g} s")

    def _has_changed(self, goal: str, status: int) -> bool:
        before = self._statuses.get(goal)
        self._statuses[goal] = status
        return status != before


def label_of(event: Event) -> str | None:
    """Return a short label for a request or an answer of the notebook's client; None for all other events."""
    match event:
        case ServiceCalled(service=service):
            return f"{service} called"
        case ServiceAnswered(call=call):
            return f"{_called(call)} answered"
        case GoalSent():
            return "goal sent"
        case GoalAnswered(accepted=accepted):
            return "goal accepted" if accepted else "goal rejected"
        case CancelSent():
            return "cancel requested"
        case CancelAnswered(canceling=canceling):
            return "cancel accepted" if canceling else "cancel not accepted"
        case ResultReceived(status=status):
            return f"result: {name_of(GoalStatus, status)}"
        case GaveUp(timeout=timeout):
            return f"no answer after {timeout:g} s"
    return None


def _request(t: float, id: str, label: str) -> Message:
    return Message(t, NOTEBOOK, f"{_called(id)} server", label, "request")


def _answer(t: float, id: str, label: str) -> Message:
    return Message(t, f"{_called(id)} server", NOTEBOOK, label, "answer")


def _published(t: float, id: str, label: str, *, repeats: bool = False) -> Message:
    return Message(t, f"{_called(id)} server", NOTEBOOK, label, "message", repeats)


def _called(id: str) -> str:
    """Return the service or action of a call or goal; `id` is its name followed by a number."""
    return id.rpartition(" ")[0]
