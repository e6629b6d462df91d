"""Frames in the plane of the floor, in plain floats because they are used 200 times a second."""

from __future__ import annotations

import math


def clamp(value: float, low: float, high: float) -> float:
    """Return the nearest number to `value` in [low, high]."""
    return low if value < low else high if value > high else value


class Frame:
    """A pose (x, y, yaw) in the plane; with `mirror` -1 its y axis points right instead of left.

    The mirror lets one equation serve both legs: in the frame of a stance foot that is mirrored for the right
    swing foot, +y is always outward, towards the swing foot.
    """

    __slots__ = ("cos", "mirror", "sin", "x", "y", "yaw")

    def __init__(self, x: float, y: float, yaw: float, mirror: float = 1.0) -> None:
        self.x, self.y, self.yaw, self.mirror = x, y, yaw, mirror
        self.cos, self.sin = math.cos(yaw), math.sin(yaw)

    def local(self, x: float, y: float) -> tuple[float, float]:
        """Return the point (x, y), m, seen in this frame."""
        dx, dy = x - self.x, y - self.y
        return self.cos * dx + self.sin * dy, (self.cos * dy - self.sin * dx) * self.mirror

    def world(self, forward: float, side: float) -> tuple[float, float]:
        """Return the point (forward, side), m, of this frame seen in the world."""
        side *= self.mirror
        return self.x + self.cos * forward - self.sin * side, self.y + self.sin * forward + self.cos * side

    def clamped(self, x: float, y: float, half_length: float, half_width: float) -> tuple[float, float]:
        """Return the point of the box ±half_length × ±half_width (m) around this frame nearest to (x, y)."""
        forward, side = self.local(x, y)
        return self.world(clamp(forward, -half_length, half_length), clamp(side, -half_width, half_width))
