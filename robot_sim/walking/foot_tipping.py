"""The reaction to a foot that tips over an edge on which it stands, such as that of a bump."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from robot_sim.walking.dcm_plan import Point

NO_SHIFT = (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class TippingParameters:
    """Gains of the reaction to a foot that tips."""

    tolerated: float = 0.05  # rad, lean of the sole against the floor
    stiffness: float = 1.0  # m/rad
    damping: float = 0.03  # m·s/rad


def cop_against_tipping(
    sole: Sequence[float], slope: Point, spin: Sequence[float], parameters: TippingParameters
) -> Point:
    """Return how far (m, along x and y of the world) to move the CoP of a foot so that its sole lies down again.

    If only a part of the sole is supported, a CoP beyond the edge of that part tips the foot over the edge, and the
    sole's normal leans in the direction of the CoP error. The CoP is moved the opposite way, by a PD law on this lean.

    Args:
        sole: rotation matrix of the sole, row by row.
        slope: rise of the floor per m along x and y.
        spin: angular velocity of the sole (x, y, z), rad/s, world frame.
        parameters: gains, and the lean that a sole on a flat floor has too.
    """
    lean_x, lean_y = sole[2] + slope[0], sole[5] + slope[1]
    lean = math.hypot(lean_x, lean_y)
    if lean < parameters.tolerated:
        return NO_SHIFT
    share = parameters.stiffness * (1 - parameters.tolerated / lean)
    # The rate of the normal, ω × n with n close to z.
    return (
        -share * lean_x - parameters.damping * spin[1],
        -share * lean_y + parameters.damping * spin[0],
    )
