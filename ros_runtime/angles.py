"""Headings: angles about the vertical axis, in rad, positive from x towards y (REP 103)."""

from __future__ import annotations

import math


def yaw_of(x: float, y: float, z: float, w: float) -> float:
    """Return the heading (rad, -π to π) of a unit quaternion with its parts in the order of ROS."""
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def wrap(angle: float) -> float:
    """Return an angle (rad) in [-π, π)."""
    return (angle + math.pi) % (2 * math.pi) - math.pi
