"""A recorded goal, with its changes of status and its feedback."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from geometry_msgs.msg import Pose, PoseStamped

from ros_runtime.angles import yaw_of
from ros_runtime.message_constants import GoalStatus, name_of
from ros_runtime.record.client_events import (
    FeedbackReceived,
    GoalAnswered,
    GoalSent,
    ResultReceived,
    StatusSeen,
)
from ros_runtime.record.event import Event


@dataclass
class RecordedGoal:
    """A goal that the notebook has sent; all times are in s, like those of its events.

    Attributes:
        sent: when the notebook sent the goal.
        request: the goal message.
        statuses: each new status with the time at which the notebook received it; "REJECTED" is not a status of ROS.
        feedback: the feedback messages with their times.
    """

    sent: float
    request: Any
    statuses: list[tuple[float, str]] = field(default_factory=list)
    feedback: list[tuple[float, Any]] = field(default_factory=list)

    def status_at(self, t: float) -> str:
        """Return the last status received by a time; "SENT" before the first status."""
        known = bisect_right([at for at, _ in self.statuses], t)
        return self.statuses[known - 1][1] if known else "SENT"

    def feedback_at(self, t: float) -> Any | None:
        """Return the last feedback message received by a time, or None."""
        known = bisect_right([at for at, _ in self.feedback], t)
        return self.feedback[known - 1][1] if known else None

    def place(self, base: Pose) -> tuple[float, float] | None:
        """Return the goal's position, (x, y) in frame odom; None for a goal without a pose.

        `base` is the robot's pose at the time of the goal.
        """
        target = next((each for each in _fields(self.request) if isinstance(each, PoseStamped)), None)
        if target is None:
            return None
        x, y = target.pose.position.x, target.pose.position.y
        if target.header.frame_id != "base_link":
            return x, y
        q = base.orientation
        yaw = yaw_of(q.x, q.y, q.z, q.w)
        return (
            base.position.x + math.cos(yaw) * x - math.sin(yaw) * y,
            base.position.y + math.sin(yaw) * x + math.cos(yaw) * y,
        )


def last_goal(events: Iterable[Event]) -> RecordedGoal | None:
    """Return the goal that was sent last, with its events; None if no goal was sent."""
    goal, name = None, ""
    for event in sorted(events, key=lambda event: event.t):
        if isinstance(event, GoalSent):
            goal, name = RecordedGoal(event.t, event.request), event.goal
        if goal is None or getattr(event, "goal", name) != name:
            continue
        match event:
            case GoalAnswered(accepted=accepted):
                _reach(goal, event.t, "ACCEPTED" if accepted else "REJECTED")
            case StatusSeen(status=status) | ResultReceived(status=status):
                _reach(goal, event.t, name_of(GoalStatus, status))
            case FeedbackReceived(feedback=feedback):
                goal.feedback.append((event.t, feedback))
    return goal


def _reach(goal: RecordedGoal, t: float, status: str) -> None:
    """Add a status unless it is known: the status topic repeats it, before or after the response that implies it."""
    if status not in [known for _, known in goal.statuses]:
        goal.statuses.append((t, status))


def _fields(message: Any) -> list[Any]:
    return [getattr(message, name) for name in message.get_fields_and_field_types()]
