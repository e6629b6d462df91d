"""The five gains: their defaults, the faults for which a value is rejected, and random valid values."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from random import Random
from typing import Any

DEFAULTS = {"kp_pitch": 276.0, "kd_pitch": 34.0, "kp_roll": 302.0, "kd_roll": 38.0, "max_torque": 10000.0}
NAMES = tuple(DEFAULTS)
PAIRS = ("kp_pitch", "kd_pitch", "kp_roll", "kd_roll")  # they determine the robot's stiffness
HIGHEST = {"kp_pitch": 1000.0, "kd_pitch": 300.0, "kp_roll": 1000.0, "kd_roll": 300.0, "max_torque": 10000.0}
MIN_KP = 51.0  # N·m/rad; with a smaller kp gravity topples the trunk
ABOVE = {
    "kp_pitch": MIN_KP,
    "kp_roll": MIN_KP,
    "max_torque": 0.0,
}  # a value equal to the limit is rejected, too
WEAKEST, STIFFEST = 0.75, 5 / 3  # as shares of the defaults; between them the robot survives a push

# Faults for which a value is rejected.
INTEGER, NOT_FINITE, NEGATIVE = "an integer", "NaN or infinite", "negative"
LIMIT, TOO_WEAK = "the limit itself", "too weak"

Gains = Mapping[str, float]


def fault_of(name: str, value: Any) -> str:
    """Return the fault for which a value of a gain is rejected, '' if it is valid."""
    if not isinstance(value, float):
        return INTEGER
    if not math.isfinite(value):
        return NOT_FINITE
    if value < 0.0:
        return NEGATIVE
    if name in ABOVE and value <= ABOVE[name]:
        return LIMIT if value == ABOVE[name] else TOO_WEAK
    return ""


def hold_the_robot(gains: Gains) -> bool:
    """Return whether the task promises that the robot survives a push with these gains."""
    return all(WEAKEST <= gains[name] / DEFAULTS[name] <= STIFFEST for name in PAIRS)


def sound_gains(random: Random) -> dict[str, float]:
    """Draw gains that hold the robot upright: its own gains, all a little weaker or stiffer."""
    stiffness = random.uniform(0.8, 1.57)
    gains = {name: round(DEFAULTS[name] * stiffness * random.uniform(0.95, 1.05), 3) for name in PAIRS}
    return gains | {"max_torque": round(random.uniform(2000.0, 8000.0), 3)}


def in_words(gains: Mapping[str, Any], names: Sequence[str] = ()) -> str:
    """Return gains, or those with these names, in words: 'kp_pitch 40.0, kd_roll -1.0'."""
    return ", ".join(f"{name} {gains[name]!r}" for name in names or gains)
