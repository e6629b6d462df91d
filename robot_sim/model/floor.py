"""What the robot walks on: a plane, level unless told otherwise, with or without bumps."""

import math
from dataclasses import dataclass

BUMP_HALF_SIZE = 0.04  # m


@dataclass(frozen=True)
class Floor:
    """A plane through the origin.

    Attributes:
        slope: rad, how steeply it rises.
        uphill: rad, the way it rises, from the x axis.
        bumps: (x, y, height) m of square bumps of 8 cm, for a level floor.
    """

    slope: float = 0.0
    uphill: float = 0.0
    bumps: tuple[tuple[float, float, float], ...] = ()

    def mjcf(self) -> str:
        """The geoms of the world that the feet meet."""
        across = f"{math.degrees(-self.slope)}"
        plane = (
            '<geom name="floor" type="plane" size="0 0 0.05" material="floor" contype="1" conaffinity="1" '
            f'axisangle="{-math.sin(self.uphill)} {math.cos(self.uphill)} 0 {across}"/>'
        )
        return plane + "".join(
            f'<geom class="furniture" type="box" pos="{x} {y} 0" size="{BUMP_HALF_SIZE} {BUMP_HALF_SIZE} {height}"/>'
            for x, y, height in self.bumps
        )
