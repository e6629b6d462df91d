"""Moments with a label, which a picture shows on its time axis."""

from __future__ import annotations

from typing import NamedTuple

from lab.client.events import GaveUp
from ros_runtime.message_constants import GoalStatus, name_of
from ros_runtime.record.client_events import (
    CancelAnswered,
    CancelSent,
    GoalAnswered,
    GoalSent,
    ResultReceived,
    ServiceAnswered,
    ServiceCalled,
)
from ros_runtime.record.event import Event


class Mark(NamedTuple):
    """A label at `time` (s, on the axis of its picture)."""

    time: float
    label: str


def label_of(event: Event) -> str | None:
    """Return a short label for a request or an answer of the notebook's client; None for all other events."""
    match event:
        case ServiceCalled(service=service):
            return f"{service} called"
        case ServiceAnswered(call=call):
            return f"{call.rpartition(' ')[0]} answered"
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
