"""The path of a foot through the air."""

from __future__ import annotations

from typing import NamedTuple

from robot_sim.model.side import Side
from robot_sim.walking.footsteps import Footstep
from ros_runtime.angles import wrap

Vector = tuple[float, float, float]


class SwingReference(NamedTuple):
    """The wanted state of the swing sole; world frame."""

    side: Side
    position: Vector  # m
    velocity: Vector  # m/s
    acceleration: Vector  # m/s²
    yaw: float  # rad
    yaw_rate: float  # rad/s
    yaw_acceleration: float  # rad/s²
    slope: tuple[float, float]  # rise per m of the floor under it, along x and y


PUSH_DOWN_SPEED = 0.3  # m/s, when touchdown is overdue


def swing_reference(
    side: Side,
    start: Footstep,
    start_height: float,
    landing: Footstep,
    landing_height: float,
    step_height: float,
    progress: float,
    rate: float,
    overdue: float,
    slope: tuple[float, float],
) -> SwingReference:
    """Return the reference of a foot at `progress` (0 to 1) of its swing, which advances at `rate` (1/s).

    The horizontal path is a quintic with zero speed and acceleration at both ends, the vertical one a bump of
    `step_height` (m). If the landing moves while the foot is in the air, the rest of the path bends. When touchdown is
    `overdue` (s), the foot is pushed down until it touches the floor.
    """
    q = progress
    blend = q * q * q * (10 + q * (6 * q - 15))
    blend_rate = 30 * q * q * (1 - q) ** 2 * rate
    blend_acceleration = (60 * q - 180 * q * q + 120 * q**3) * rate * rate
    bump = 16 * q * q * (1 - q) ** 2 * step_height
    bump_rate = 16 * (2 * q - 6 * q * q + 4 * q**3) * step_height * rate
    bump_acceleration = 16 * (2 - 12 * q + 12 * q * q) * step_height * rate * rate
    if overdue > 0:
        bump, bump_rate, bump_acceleration = bump - PUSH_DOWN_SPEED * overdue, -PUSH_DOWN_SPEED, 0.0

    dx, dy, dz = landing.x - start.x, landing.y - start.y, landing_height - start_height
    turn = wrap(landing.yaw - start.yaw)
    return SwingReference(
        side,
        (start.x + dx * blend, start.y + dy * blend, start_height + dz * blend + bump),
        (dx * blend_rate, dy * blend_rate, dz * blend_rate + bump_rate),
        (dx * blend_acceleration, dy * blend_acceleration, bump_acceleration),
        start.yaw + turn * blend,
        turn * blend_rate,
        turn * blend_acceleration,
        slope,
    )
