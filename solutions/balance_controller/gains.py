"""The five gains: their defaults, and how a request for a change of them is written in a scenario's inputs."""

from __future__ import annotations

from random import Random
from typing import Any

DEFAULTS = {"kp_pitch": 276.0, "kd_pitch": 34.0, "kp_roll": 302.0, "kd_roll": 38.0, "max_torque": 10000.0}
NAMES = tuple(DEFAULTS)
HIGHEST = {"kp_pitch": 1000.0, "kd_pitch": 300.0, "kp_roll": 1000.0, "kd_roll": 300.0, "max_torque": 10000.0}
TOPPLE = 51.0  # N·m/rad, with which gravity topples the trunk

Set = dict[str, Any]


def set_each(name: str, **values: Any) -> Set:
    """Return a request to set_parameters, in which each parameter is a set of its own."""
    return {"name": name, "values": values, "atomically": False}


def set_together(name: str, **values: Any) -> Set:
    """Return a request to set_parameters_atomically."""
    return {"name": name, "values": values, "atomically": True}


def lowest_gains(random: Random) -> dict[str, float]:
    """Draw gains at the lower ends of the task's table, which are accepted although they hold no robot."""
    kp = {name: round(random.uniform(51.1, 60.0), 1) for name in ("kp_pitch", "kp_roll")}
    return kp | {"kd_pitch": 0.0, "kd_roll": 0.0, "max_torque": round(random.uniform(0.1, 5.0), 1)}


def sound_gains(random: Random) -> dict[str, float]:
    """Draw gains that hold the robot upright: all of the robot's own, made a little weaker or stiffer."""
    stiffness = random.uniform(0.8, 1.6)
    gains = {
        name: round(DEFAULTS[name] * stiffness * random.uniform(0.95, 1.05), 1)
        for name in NAMES
        if name != "max_torque"
    }
    return gains | {"max_torque": round(random.uniform(2000.0, 8000.0), 1)}
