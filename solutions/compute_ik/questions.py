"""Questions to compute_ik that are drawn: [x, y, elbow_up], m."""

from __future__ import annotations

import math
from random import Random
from typing import Any

from .two_link_arm import TwoLinkArm

AT_A_LIMIT = 0.002  # m from a limit of the reach: twice what the statement leaves open


def anywhere(random: Random, arm: TwoLinkArm) -> list[Any]:
    """Draw a point that an arm reaches, in any direction, the ends of the reach as often as the middle."""
    part = random.choice([random.uniform(0.0, 0.05), random.uniform(0.0, 1.0), random.uniform(0.95, 1.0)])
    nearest, farthest = arm.nearest + AT_A_LIMIT, arm.farthest - AT_A_LIMIT
    return at_distance(random, nearest + part * (farthest - nearest))


def at_distance(random: Random, distance: float) -> list[Any]:
    """Draw a point so far (m) from the shoulder, ahead of it more often than not."""
    direction = random.uniform(-math.pi, math.pi) / random.choice([1.0, 2.5])
    x, y = distance * math.cos(direction), distance * math.sin(direction)
    return [round(x, 5), round(y, 5), random.random() < 0.5]
