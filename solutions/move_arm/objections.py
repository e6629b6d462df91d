"""What speaks against a goal that moves an arm: what its request holds."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from autograder.authoring.goal import Goal
from autograder.authoring.walking.objections import Objection

from .plan import seconds_of
from .ranges import RANGES

ARMS = ("l", "r")
AT_THE_END = 0.001  # rad; what is so near the end of a range may be rounded


def _is_foreign(goal: Goal, joint: str) -> bool:
    return joint not in RANGES or not joint.startswith(f"{goal.request.arm}_")


def _foreign(goal: Goal) -> list[str]:
    names = goal.request.trajectory.joint_names if goal.request.arm in ARMS else ()
    return [name for name in names if _is_foreign(goal, name)]


def _odd_points(goal: Goal) -> list[int]:
    joints = len(goal.request.trajectory.joint_names)
    return [n for n, point in enumerate(goal.request.trajectory.points) if len(point.positions) != joints]


def _unordered_points(goal: Goal) -> list[int]:
    times = map(seconds_of, goal.request.trajectory.points)
    return [n for n, (earlier, later) in enumerate(pairwise(times), start=1) if later <= earlier]


def _unending_positions(goal: Goal) -> list[float]:
    points = goal.request.trajectory.points
    return [position for point in points for position in point.positions if not math.isfinite(position)]


def _beyond(goal: Goal, slack: float) -> Iterator[str]:
    """Yield each position that is finite and beyond its joint's range by more than `slack` (rad), in words."""
    for number, point in enumerate(goal.request.trajectory.points):
        for joint, position in zip(goal.request.trajectory.joint_names, point.positions, strict=False):
            lower, upper = RANGES.get(joint, (-math.inf, math.inf))
            if math.isfinite(position) and not lower - slack <= position <= upper + slack:
                yield f"{joint} cannot get to {position:.2f} rad (point {number})"


def _is_beyond(goal: Goal) -> bool | None:
    surely, perhaps = any(_beyond(goal, AT_THE_END)), any(_beyond(goal, -AT_THE_END))
    return surely if surely == perhaps else None


def _is_left_open(goal: Goal) -> bool:
    names, points = list(goal.request.trajectory.joint_names), goal.request.trajectory.points
    is_early = bool(points) and seconds_of(points[0]) <= 0.0
    tolerance = goal.request.goal_tolerance
    return not names or len(set(names)) < len(names) or is_early or not 0.0 <= tolerance < math.inf


ARM = Objection(
    lambda goal: f"the robot has the arms l and r, and no {goal.request.arm}",
    "Look at goal_request.arm in goal_callback.",
    lambda goal: goal.request.arm not in ARMS,
)
JOINT = Objection(
    lambda goal: f"{_foreign(goal)[0]} is not a joint of the arm {goal.request.arm}",
    "An arm has the joints in joint_limits.names that begin with its letter, l_ or r_. A leg's joint begins so, too, "
    "but is not in that list.",
    lambda goal: bool(_foreign(goal)),
)
NO_POINT = Objection(
    lambda goal: "there is nowhere to go",
    "An empty list is false: `if not trajectory.points`.",
    lambda goal: not goal.request.trajectory.points,
)
LENGTH = Objection(
    lambda goal: f"point {_odd_points(goal)[0]} has too few or too many positions",
    "Compare len(point.positions) with len(trajectory.joint_names), for every point.",
    lambda goal: bool(_odd_points(goal)),
)
TIMES = Objection(
    lambda goal: f"point {_unordered_points(goal)[0]} is not later than the point before",
    "time_from_start.sec + time_from_start.nanosec * 1e-9 must be greater than that of the point before.",
    lambda goal: bool(_unordered_points(goal)),
)
NOT_FINITE = Objection(
    lambda goal: f"a position is {_unending_positions(goal)[0]:g}, not a finite number",
    "Test every position of every point with math.isfinite(): NaN compares false with everything, so it is neither "
    "below nor above a limit.",
    lambda goal: bool(_unending_positions(goal)),
)
RANGE = Objection(
    lambda goal: next(_beyond(goal, AT_THE_END)),
    "Look at every position of every point, and compare it with lower and upper of this very joint in joint_limits: "
    "the right arm's ranges mirror the left one's.",
    _is_beyond,
)
# What the statement leaves open: no joint, a joint twice, a first time of 0, a tolerance that is none.
UNSAID = Objection(lambda goal: "", "", lambda goal: None if _is_left_open(goal) else False)
AGAINST = (ARM, JOINT, NO_POINT, LENGTH, TIMES, NOT_FINITE, RANGE)
