"""What speaks against a goal that moves an arm: what its request holds."""

from __future__ import annotations

import math
from itertools import pairwise

from autograder.authoring import Goal
from autograder.authoring.walking.objections import objection
from autograder.authoring.walking.obligations.reporting import seconds

ARMS = ("l", "r")
AT_THE_END = 0.001  # rad; what is so near the end of a range may be rounded
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
# How far the arms' joints can turn (rad), as the robot publishes it on joint_limits.
RANGES = {
    f"{side}_{joint}": (math.radians(lower), math.radians(upper))
    for side, ranges in (("l", _LEFT), ("r", _RIGHT))
    for joint, (lower, upper) in ranges.items()
}


@objection("Look at goal_request.arm in goal_callback.")
def arms(goal: Goal) -> str:
    """It rejects an arm that is neither l nor r."""
    arm = goal.request.arm
    return "" if arm in ARMS else f"the robot has the arms l and r, and no {arm}"


@objection(
    "An arm has the joints in joint_limits.names that begin with its letter, l_ or r_. A leg's joint begins so, too, "
    "but is not in that list."
)
def joints(goal: Goal) -> str:
    """It rejects joints that are not this arm's."""
    arm = goal.request.arm
    for joint in goal.request.trajectory.joint_names if arm in ARMS else ():
        if joint not in RANGES or not joint.startswith(f"{arm}_"):
            return f"{joint} is not a joint of the arm {arm}"
    return ""


@objection("An empty list is false: `if not trajectory.points`.")
def no_point(goal: Goal) -> str:
    """It rejects a trajectory without a point."""
    return "" if goal.request.trajectory.points else "there is nowhere to go"


@objection("Compare len(point.positions) with len(trajectory.joint_names), for every point.")
def lengths(goal: Goal) -> str:
    """It rejects points with too few or too many positions."""
    joints = len(goal.request.trajectory.joint_names)
    for number, point in enumerate(goal.request.trajectory.points):
        if len(point.positions) != joints:
            return f"point {number} has too few or too many positions"
    return ""


@objection(
    "time_from_start.sec + time_from_start.nanosec * 1e-9 must be greater than that of the point before."
)
def times(goal: Goal) -> str:
    """It rejects a trajectory whose times do not rise from point to point."""
    times = (seconds(point.time_from_start) for point in goal.request.trajectory.points)
    for number, (earlier, later) in enumerate(pairwise(times), start=1):
        if later <= earlier:
            return f"point {number} is not later than the point before"
    return ""


@objection(
    "Test every position of every point with math.isfinite(): every `<` and `>` with NaN is false, so it is neither "
    "below nor above a limit."
)
def not_finite(goal: Goal) -> str:
    """It rejects a trajectory that holds NaN or an infinite position."""
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
                return f"{joint} cannot get to {position:.2f} rad (point {number})"
    return ""


@objection(
    "Look at every position of every point, and compare it with lower and upper of this very joint in joint_limits: "
    "the right arm's ranges mirror the left one's."
)
def beyond(goal: Goal) -> str | None:
    """It rejects a position outside the joint's range."""
    surely, perhaps = _beyond(goal, AT_THE_END), _beyond(goal, -AT_THE_END)
    return surely if bool(surely) == bool(perhaps) else None


def _is_left_open(goal: Goal) -> bool:
    """Return whether it has no joint, a joint twice, a first time of 0, or a tolerance that is none."""
    names, points = list(goal.request.trajectory.joint_names), goal.request.trajectory.points
    is_early = bool(points) and seconds(points[0].time_from_start) <= 0.0
    tolerance = goal.request.goal_tolerance
    return not names or len(set(names)) < len(names) or is_early or not 0.0 <= tolerance < math.inf


AGAINST = (
    *(arms, joints, no_point, lengths),
    *(times, not_finite, beyond),
)


def is_sound(goal: Goal) -> bool:
    """Return whether nothing speaks against a goal, and the statement says what it asks for."""
    return all(each.because(goal) == "" for each in AGAINST) and not _is_left_open(goal)
