"""Types of the arguments of steps, which name their units: a failure shows "x 0.55 m" for `x: Metres`."""

from __future__ import annotations

Metres = float
Radians = float
Seconds = float

UNITS = {"Metres": "m", "Radians": "rad", "Seconds": "s"}  # by the name of a type
