"""When the robot counts as fallen."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FallThresholds:
    """Below either of them the robot has fallen."""

    base_height: float = 0.38  # m, of the pelvis above the origin
    up: float = 0.6  # z component of the torso's up-vector: 1 upright, 0 lying


def has_fallen(height: float, up: float, thresholds: FallThresholds) -> bool:
    """Whether a robot lies, given the height (m) of its pelvis and `up`, the z component of its torso's up-vector."""
    return height < thresholds.base_height or up < thresholds.up
