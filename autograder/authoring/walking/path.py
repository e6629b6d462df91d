"""The path that a robot really walked, without the sway of its pelvis."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from statistics import fmean

from autograder.authoring.evidence.robot_record import RobotRecord

STRIDE = 1.0  # s, two steps: the pelvis sways once to each side
SPACING = 0.1  # s between the points of the path

Point = tuple[float, float]  # m, m in odom


def length_walked(run: RobotRecord, start: float, end: float, spacing: float = SPACING) -> float:
    """Return how far (m) the robot walked between two moments (s).

    Each point of the path is the mean of the pelvis's positions over one stride, so that the sway cancels out. A small
    rest of the sway remains, and adds up when the robot walks slowly; points that are a stride apart (`spacing`, s)
    avoid that.
    """
    times = [start + spacing * k for k in range(int((end - start) / spacing) + 1)]
    return length([_middle(run, t) for t in dict.fromkeys([*times, end])])


def length_without_sway(run: RobotRecord, start: float, end: float, spacing: float) -> float:
    """Return how far (m) the robot walked between two moments (s), as a server measures it that filters by distance.

    A point of the pelvis's path counts only if it is farther than `spacing` (m) from the last one that counts. Small
    steps in place, with which a robot turns, do not count, whatever its sway.
    """
    positions = [(robot.x, robot.y) for robot in run.robot_between(start, end)]
    counted = positions[:1]
    for position in positions:
        if math.dist(position, counted[-1]) > spacing:
            counted.append(position)
    return length([*counted, *positions[-1:]])


def length(points: Sequence[Point]) -> float:
    """Return the length (m) of a polyline."""
    return sum(math.dist(one, next) for one, next in pairwise(points))


def walking_speed(run: RobotRecord, t: float) -> float:
    """Return the speed (m/s) of the body at a time (s), as a mean over the stride around it."""
    return math.dist(_middle(run, t - STRIDE / 2), _middle(run, t + STRIDE / 2)) / STRIDE


def _middle(run: RobotRecord, t: float) -> Point:
    robots = run.robot_between(t - STRIDE / 2, min(t + STRIDE / 2, run.ground_truth[-1].t))
    return fmean([robot.x for robot in robots]), fmean([robot.y for robot in robots])
