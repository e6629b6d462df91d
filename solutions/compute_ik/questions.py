"""Requests to compute_ik, as a scenario sends them."""

from __future__ import annotations

import math
from random import Random
from typing import Any

from .two_link_arm import TwoLinkArm

Request = dict[str, Any]

MARGIN = 0.02  # m that drawn points keep from the border of what can be reached


def ask_for(x: float, y: float, *, elbow_up: bool = False, frame: str = "shoulder") -> Request:
    """Return the request for a point (m) in a frame."""
    return {
        "target": {"header": {"frame_id": frame}, "point": {"x": x, "y": y, "z": 0.0}},
        "elbow_up": elbow_up,
    }


def ask_for_both(x: float, y: float) -> list[Request]:
    """Return the requests for a point with the elbow below and above."""
    return [ask_for(x, y, elbow_up=elbow_up) for elbow_up in (False, True)]


def anywhere(random: Random, arm: TwoLinkArm) -> Request:
    """Draw a point that an arm reaches, in any direction."""
    distance = random.uniform(arm.nearest + MARGIN, arm.farthest - MARGIN)
    return _draw(random, distance, random.uniform(-math.pi, math.pi))


def ahead(random: Random, nearest: float, farthest: float) -> Request:
    """Draw a point between two distances (m), at least 0.35 rad off the vertical."""
    widest = math.pi / 2 - 0.35
    return _draw(random, random.uniform(nearest, farthest), random.uniform(-widest, widest))


def _draw(random: Random, distance: float, direction: float) -> Request:
    x, y = distance * math.cos(direction), distance * math.sin(direction)
    return ask_for(round(x, 4), round(y, 4), elbow_up=random.random() < 0.5)
