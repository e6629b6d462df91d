"""How far the arms' joints can turn, as the robot publishes it on joint_limits."""

from __future__ import annotations

import math

_LEFT = {  # degrees
    "shoulder_pitch": (-170, 70),
    "shoulder_roll": (-20, 120),
    "shoulder_yaw": (-90, 90),
    "elbow": (-135, 0),
    "wrist_yaw": (-120, 120),
    "wrist_pitch": (-90, 90),
    "wrist_roll": (-60, 60),
}
_MIRRORED = ("shoulder_roll",)


def _range_of(side: str, joint: str) -> tuple[float, float]:
    lower, upper = map(math.radians, _LEFT[joint])
    return (-upper, -lower) if side == "r" and joint in _MIRRORED else (lower, upper)


RANGES = {f"{side}_{joint}": _range_of(side, joint) for side in "lr" for joint in _LEFT}  # rad
