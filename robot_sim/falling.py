"""Decides whether the robot has fallen."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FallThresholds:
    """Below either of them the robot has fallen."""

    base_height: float = 0.38  # m, of the pelvis above the origin
    up: float = 0.6  # z component of the torso's up-vector: 1 upright, 0 lying


def has_fallen(height: float, up: float, thresholds: FallThresholds) -> bool:
    """Return whether a robot with its pelvis at a height (m) has fallen; `up` is z of its torso's up-vector."""
    return height < thresholds.base_height or up < thresholds.up
