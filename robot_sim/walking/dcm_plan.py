"""The divergent component of motion (DCM) of walking on a plane, one horizontal axis or point at a time.

With the centre of mass c at constant height, ω = √(g/h) and the centre of pressure p, the DCM ξ = c + ċ/ω
obeys ξ̇ = ω (ξ - p): it runs away from p, and c follows it. Hence ξ(t) = p + (ξ₀ - p) exp(ω t).

J. Englsberger, C. Ott, A. Albu-Schäffer, "Three-dimensional bipedal walking control based on divergent
component of motion", IEEE Transactions on Robotics 31(2), 2015.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from robot_sim.walking.footsteps import Footstep

Point = tuple[float, float]


def dcm_after(dcm: Point, cop: Point, omega: float, duration: float) -> Point:
    """Return where the DCM (m) will be after `duration` (s) with the CoP held still."""
    growth = math.exp(omega * duration)
    return cop[0] + growth * (dcm[0] - cop[0]), cop[1] + growth * (dcm[1] - cop[1])


def dcm_before(dcm: Point, cop: Point, omega: float, duration: float) -> Point:
    """Return where the DCM (m) must be `duration` (s) earlier with the CoP held still."""
    return dcm_after(dcm, cop, omega, -duration)


def cop_to_reach(goal: Point, dcm: Point, omega: float, duration: float) -> Point:
    """Return the constant CoP (m) that brings the DCM to `goal` in `duration` (s)."""
    growth = math.exp(omega * duration)
    return (goal[0] - growth * dcm[0]) / (1 - growth), (goal[1] - growth * dcm[1]) / (1 - growth)


def dcm_at_touchdown(footsteps: Sequence[Footstep], omega: float, duration: float) -> Point:
    """Return the DCM (m) wanted when the first of `footsteps` lands, each step lasting `duration` (s).

    Backward recursion from rest: at the end the DCM is midway between the last two feet.
    """
    last, before = footsteps[-1], footsteps[-2]
    dcm = ((last.x + before.x) / 2, (last.y + before.y) / 2)
    for foot in reversed(footsteps[:-1]):
        dcm = dcm_before(dcm, (foot.x, foot.y), omega, duration)
    return dcm


def time_to_reach(goal: float, dcm: float, cop: float, omega: float) -> float:
    """Return the time (s) in which the DCM runs from `dcm` to `goal` on one axis, both on one side of the CoP.

    The closed form behind step timing adaptation: M. Khadiv, A. Herzog, S. A. A. Moosavian, L. Righetti,
    "Step timing adjustment: a step toward generating robust gaits", IEEE-RAS Humanoids, 2016.
    """
    return math.log((goal - cop) / (dcm - cop)) / omega
