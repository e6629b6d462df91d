"""What speaks against a goal that moves an arm: what its request holds."""

from __future__ import annotations

import math
from itertools import pairwise

from autograder.authoring import Goal
from autograder.authoring.walking.objections import Objection

from .plan import seconds_of
from .ranges import RANGES

ARMS = ("l", "r")
AT_THE_END = 0.001  # rad; what is so near the end of a range may be rounded


def _is_no_arm(goal: Goal) -> str:
    arm = goal.request.arm
    return "" if arm in ARMS else f"the robot has the arms l and r, and no {arm}"


def _has_foreign_joint(goal: Goal) -> str:
    arm = goal.request.arm
    for joint in goal.request.trajectory.joint_names if arm in ARMS else ():
        if joint not in RANGES or not joint.startswith(f"{arm}_"):
            return f"{joint} is not a joint of the arm {arm}"
    return ""


def _has_odd_point(goal: Goal) -> str:
    joints = len(goal.request.trajectory.joint_names)
    for number, point in enumerate(goal.request.trajectory.points):
        if len(point.positions) != joints:
            return f"point {number} has too few or too many positions"
    return ""


def _has_unordered_times(goal: Goal) -> str:
    times = map(seconds_of, goal.request.trajectory.points)
    for number, (earlier, later) in enumerate(pairwise(times), start=1):
        if later <= earlier:
            return f"point {number} is not later than the point before"
    return ""


def _is_not_finite(goal: Goal) -> str:
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


def _is_beyond(goal: Goal) -> str | None:
    surely, perhaps = _beyond(goal, AT_THE_END), _beyond(goal, -AT_THE_END)
    return surely if bool(surely) == bool(perhaps) else None


def _is_left_open(goal: Goal) -> bool:
    names, points = list(goal.request.trajectory.joint_names), goal.request.trajectory.points
    is_early = bool(points) and seconds_of(points[0]) <= 0.0
    tolerance = goal.request.goal_tolerance
    return not names or len(set(names)) < len(names) or is_early or not 0.0 <= tolerance < math.inf


ARM = Objection(
    _is_no_arm,
    "Look at goal_request.arm in goal_callback.",
    "rejects_arms",
    "It rejects an arm that is neither l nor r",
)
JOINT = Objection(
    _has_foreign_joint,
    "An arm has the joints in joint_limits.names that begin with its letter, l_ or r_. A leg's joint begins so, too, "
    "but is not in that list.",
    "rejects_joints",
    "It rejects joints that are not this arm's",
)
NO_POINT = Objection(
    lambda goal: "" if goal.request.trajectory.points else "there is nowhere to go",
    "An empty list is false: `if not trajectory.points`.",
    "rejects_no_point",
    "It rejects a trajectory without a point",
)
LENGTH = Objection(
    _has_odd_point,
    "Compare len(point.positions) with len(trajectory.joint_names), for every point.",
    "rejects_lengths",
    "It rejects points with too few or too many positions",
)
TIMES = Objection(
    _has_unordered_times,
    "time_from_start.sec + time_from_start.nanosec * 1e-9 must be greater than that of the point before.",
    "rejects_times",
    "It rejects a trajectory whose times do not rise from point to point",
)
NOT_FINITE = Objection(
    _is_not_finite,
    "Test every position of every point with math.isfinite(): every `<` and `>` with NaN is false, so it is neither "
    "below nor above a limit.",
    "rejects_not_finite",
    "It rejects a trajectory that holds NaN or an infinite position",
)
RANGE = Objection(
    _is_beyond,
    "Look at every position of every point, and compare it with lower and upper of this very joint in joint_limits: "
    "the right arm's ranges mirror the left one's.",
    "rejects_beyond",
    "It rejects a position outside the joint's range",
)
# What the statement leaves open: no joint, a joint twice, a first time of 0, a tolerance that is none.
UNSAID = Objection(lambda goal: None if _is_left_open(goal) else "")
AGAINST = (ARM, JOINT, NO_POINT, LENGTH, TIMES, NOT_FINITE, RANGE, UNSAID)


def is_sound(goal: Goal) -> bool:
    """Return whether nothing speaks against a goal."""
    return all(objection.because(goal) == "" for objection in AGAINST)
