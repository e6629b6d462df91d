"""A goal that was reached, and what was told on the way to it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from builtin_interfaces.msg import Duration

from autograder.authoring import events as ev
from autograder.authoring.feedback import require_feedback
from autograder.authoring.goal import SUCCEEDED, Goal
from autograder.authoring.missing import unseen
from autograder.authoring.walking.planar import error, target
from ros_runtime.angles import wrap

ON_THE_WAY = 0.3  # m left, at least, where the robot is under way


@dataclass(frozen=True)
class Leg:
    """A goal that was reached, with the moment when half of its distance was left."""

    goal: Goal
    start: float  # s
    half: float  # s
    end: float  # s

    @staticmethod
    def of(goal: Goal) -> Leg:
        """Return the walk to a goal, which must have succeeded."""
        end = goal.require_accepted().require_result(SUCCEEDED).t
        start = goal.accepted_at
        whole, _turn = error(goal.run.robot_at(start), goal)
        for robot in goal.run.robot_between(start, end):
            if error(robot, goal)[0] <= whole / 2:
                return Leg(goal, start, robot.t, end)
        raise unseen(goal.run, f"the robot was never half way to “{goal.name}”")


def seconds(duration: Duration) -> float:
    """Return a duration in s."""
    return float(duration.sec + duration.nanosec * 1e-9)


def off_the_way(robot: ev.RobotTruth, goal: Goal) -> float:
    """Return the angle (rad, 0 to pi) between the robot's heading and the bearing of its goal."""
    place = target(goal).position
    return abs(wrap(robot.yaw - math.atan2(place.y - robot.y, place.x - robot.x)))


def under_way(goal: Goal) -> Sequence[ev.FeedbackReceived]:
    """Return the feedback that came while more than 0.3 m were left, of which there must be some."""
    require_feedback(goal)
    far = [f for f in goal.feedback if error(goal.run.robot_at(f.t), goal)[0] > ON_THE_WAY]
    if not far:
        raise unseen(goal.run, f"the robot was never under way to “{goal.name}”")
    return far


def told(goal: Goal) -> list[ev.FeedbackReceived]:
    """Return the feedback until the result; what comes later is another check's business."""
    return [feedback for feedback in goal.feedback if goal.result is None or feedback.t <= goal.result.t]


def at_moment(goal: Goal, t: float) -> ev.FeedbackReceived:
    """Return the last feedback not later than a moment, or the first."""
    require_feedback(goal)
    return next((feedback for feedback in reversed(goal.feedback) if feedback.t <= t), goal.feedback[0])
