"""The contact wrench that a motion needs, its centre of pressure, and its split between the feet."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from robot_sim.model.dimensions import Dimensions
from robot_sim.model.gravity import GRAVITY
from robot_sim.model.side import Side
from robot_sim.walking.attitude import to_world
from robot_sim.walking.balance_parameters import BalanceParameters
from robot_sim.walking.dcm_plan import Point
from robot_sim.walking.planar import Frame, clamp
from robot_sim.walking.sensing import Sensing

NO_WRENCH = (0.0,) * 6


class ContactWrench(NamedTuple):
    """The floor's force (N) on the robot, acting at the CoP (m) with a yaw moment (N·m)."""

    fx: float
    fy: float
    fz: float
    yaw_moment: float
    cop: Point


def contact_wrench(
    base_rows: Sequence[float], sensed: Sensing, mass: float, limits: BalanceParameters
) -> ContactWrench:
    """Return the wrench that makes the base move as wanted.

    The CoP is the point of the floor about which the moment has no horizontal part: P. Sardain, G. Bessonnet,
    "Forces acting on a biped robot. Center of pressure - zero moment point", IEEE Transactions on Systems,
    Man, and Cybernetics A 34(5), 2004.

    Args:
        base_rows: the six generalized forces of the free joint that the motion needs: force (N) in the world,
            moment (N·m) in and about base_link. The joint has no motor, so only the floor can supply them.
        sensed: the robot's present state.
        mass: of the robot, kg.
        limits: of load and friction; the force is clamped to them.
    """
    fx, fy, fz = base_rows[:3]
    weight = mass * GRAVITY
    fz = clamp(fz, limits.min_load * weight, limits.max_load * weight)
    sliding, grip = math.hypot(fx, fy), limits.friction * fz
    if sliding > grip:
        fx, fy = fx * grip / sliding, fy * grip / sliding
    roll, pitch, yaw = base_rows[3:]
    moment_x, moment_y, moment_z = to_world(sensed.pelvis_rotation, (roll, pitch, yaw))
    x, y, z = sensed.pelvis[0], sensed.pelvis[1], sensed.pelvis[2] - sensed.ground
    moment_x += y * fz - z * fy
    moment_y += z * fx - x * fz
    moment_z += x * fy - y * fx
    cop_x, cop_y = -moment_y / fz, moment_x / fz
    return ContactWrench(fx, fy, fz, moment_z - (cop_x * fy - cop_y * fx), (cop_x, cop_y))


class LoadSplit:
    """The split of a contact wrench between the feet, with each CoP on its sole."""

    def __init__(self, size: Dimensions, limits: BalanceParameters) -> None:
        self._length = size.sole_half_length * limits.sole_edge_share
        self._width = size.sole_half_width * limits.sole_edge_share
        self._yaw_lever = limits.yaw_moment_per_load

    def foot_wrench(
        self, side: Side, wrench: ContactWrench, left_share: float, sensed: Sensing, shift: Point
    ) -> tuple[float, ...]:
        """Return the force (N) and moment (N·m) about the sole's centre, world frame; zeros for a foot without load.

        The offset of the foot's CoP from its sole's centre is the offset of the total CoP from the load-weighted mean
        of both centres, plus `shift` (m).
        """
        share = left_share if side is Side.LEFT else 1 - left_share
        if share < 1e-3:
            return NO_WRENCH
        left, right = sensed.soles
        middle_x = left_share * left[0] + (1 - left_share) * right[0]
        middle_y = left_share * left[1] + (1 - left_share) * right[1]
        around_sole = Frame(0.0, 0.0, sensed.foot_yaws[side])
        offset_x, offset_y = around_sole.clamped(
            wrench.cop[0] - middle_x + shift[0],
            wrench.cop[1] - middle_y + shift[1],
            self._length,
            self._width,
        )
        fx, fy, fz = wrench.fx * share, wrench.fy * share, wrench.fz * share
        strongest = self._yaw_lever * fz
        yaw_moment = clamp(wrench.yaw_moment * share, -strongest, strongest)
        return fx, fy, fz, offset_y * fz, -offset_x * fz, offset_x * fy - offset_y * fx + yaw_moment
