"""Reasons to reject a goal of move_arm because of its request."""

from __future__ import annotations

import math
from itertools import pairwise

from autograder.authoring import Goal
from autograder.authoring.walking.objections import objection
from autograder.authoring.walking.obligations.reporting import seconds

ARMS = ("l", "r")
ROUNDING = 0.001  # rad; a position this near to the end of a range may be accepted or rejected
_LEFT = {  # degrees
    "shoulder_pitch": (-170, 70),
    "shoulder_roll": (-20, 120),
    "shoulder_yaw": (-90, 90),
    "elbow": (-135, 0),
    "wrist_yaw": (-120, 120),
    "wrist_pitch": (-90, 90),
    "wrist_roll": (-60, 60),
}
_RIGHT = {**_LEFT, "shoulder_roll": (-120, 20)}
# The ranges of the arms' joints (rad), which the robot publishes on joint_limits.
RANGES = {
    f"{side}_{joint}": (math.radians(lower), math.radians(upper))
    for side, ranges in (("l", _LEFT), ("r", _RIGHT))
    for joint, (lower, upper) in ranges.items()
}


@objection("Compare goal_request.arm with 'l' and 'r' in goal_callback.")
def arms(goal: Goal) -> str:
    """It rejects an arm that is neither l nor r."""
    arm = goal.request.arm
    return "" if arm in ARMS else f"the robot has the arms 'l' and 'r', but no arm {arm!r}"


@objection(
    "An arm's joints are those in joint_limits.names that begin with l_ or r_. The names of leg joints begin like "
    "this, too, but are not in that list."
)
def joints(goal: Goal) -> str:
    """It rejects joints that do not belong to the goal's arm."""
    arm = goal.request.arm
    for joint in goal.request.trajectory.joint_names if arm in ARMS else ():
        if joint not in RANGES or not joint.startswith(f"{arm}_"):
            return f"{joint} is not a joint of the arm {arm!r}"
    return ""


@objection("Return GoalResponse.REJECT `if not goal_request.trajectory.points`: an empty list is false.")
def no_point(goal: Goal) -> str:
    """It rejects a trajectory without points."""
    return "" if goal.request.trajectory.points else "the trajectory has no points"


@objection("Compare len(point.positions) with len(trajectory.joint_names), for every point.")
def lengths(goal: Goal) -> str:
    """It rejects points with too few or too many positions."""
    joints = len(goal.request.trajectory.joint_names)
    for number, point in enumerate(goal.request.trajectory.points):
        if len(point.positions) != joints:
            return f"point {number} has too few or too many positions"
    return ""


@objection("time_from_start.sec + time_from_start.nanosec * 1e-9 must be greater than in the previous point.")
def times(goal: Goal) -> str:
    """It rejects a trajectory whose times do not increase from point to point."""
    times = (seconds(point.time_from_start) for point in goal.request.trajectory.points)
    for number, (earlier, later) in enumerate(pairwise(times), start=1):
        if later <= earlier:
            return f"point {number} is not later than the previous point"
    return ""


@objection(
    "Test every position of every point with math.isfinite(). A comparison with the limits does not find NaN, as "
    "every `<` and `>` with NaN is false."
)
def not_finite(goal: Goal) -> str:
    """It rejects a trajectory with a NaN or infinite position."""
    for point in goal.request.trajectory.points:
        for position in point.positions:
            if not math.isfinite(position):
                return f"a position is {position:g}, not a finite number"
    return ""


def _beyond(goal: Goal, slack: float) -> str:
    """Return the first position that is finite and beyond its joint's range by more than `slack` (rad), in words."""
    for number, point in enumerate(goal.request.trajectory.points):
        for joint, position in zip(goal.request.trajectory.joint_names, point.positions, strict=False):
            lower, upper = RANGES.get(joint, (-math.inf, math.inf))
            if math.isfinite(position) and not lower - slack <= position <= upper + slack:
                return f"{joint} cannot reach {position:.2f} rad (point {number})"
    return ""


@objection(
    "Compare every position of every point with lower and upper of the same joint in joint_limits: the ranges of the "
    "right arm mirror those of the left."
)
def beyond(goal: Goal) -> str | None:
    """It rejects a position outside the joint's range."""
    surely, perhaps = _beyond(goal, ROUNDING), _beyond(goal, -ROUNDING)
    return surely if bool(surely) == bool(perhaps) else None


def _is_left_open(goal: Goal) -> bool:
    """Return whether it has no joint, a joint twice, a first time of 0, or an invalid tolerance."""
    names, points = list(goal.request.trajectory.joint_names), goal.request.trajectory.points
    is_early = bool(points) and seconds(points[0].time_from_start) <= 0.0
    tolerance = goal.request.goal_tolerance
    return not names or len(set(names)) < len(names) or is_early or not 0.0 <= tolerance < math.inf


AGAINST = (
    *(arms, joints, no_point, lengths),
    *(times, not_finite, beyond),
)


def is_sound(goal: Goal) -> bool:
    """Return whether there is no reason to reject a goal, and the statement defines how it is carried out."""
    return all(each.because(goal) == "" for each in AGAINST) and not _is_left_open(goal)
