"""The floor that the robot walks on: a plane, level by default, with or without bumps."""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco

BUMP_HALF_SIZE = 0.04  # m


@dataclass(frozen=True)
class Floor:
    """A plane through the origin.

    Attributes:
        slope: rad, how steeply it rises.
        uphill: rad, the direction in which it rises, from the x axis.
        bumps: (x, y, height) m of square bumps of 8 cm, for a level floor.
    """

    slope: float = 0.0
    uphill: float = 0.0
    bumps: tuple[tuple[float, float, float], ...] = ()

    def shape(self, spec: mujoco.MjSpec) -> None:
        """Tilt the plane "floor" of a model before it is compiled, and put the bumps on it."""
        orientation = spec.geom("floor").alt
        orientation.type = mujoco.mjtOrientation.mjORIENTATION_AXISANGLE
        across = (-math.sin(self.uphill), math.cos(self.uphill), 0.0)
        orientation.axisangle = (*across, math.degrees(-self.slope))
        furniture = spec.find_default("furniture")
        for x, y, height in self.bumps:
            spec.worldbody.add_geom(
                furniture,
                type=mujoco.mjtGeom.mjGEOM_BOX,
                pos=(x, y, 0.0),
                size=(BUMP_HALF_SIZE, BUMP_HALF_SIZE, height),
            )
