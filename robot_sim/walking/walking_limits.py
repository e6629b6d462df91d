"""The velocities that the robot can walk at."""

from __future__ import annotations

import math
from dataclasses import dataclass

from robot_sim.walking.footsteps import Velocity
from robot_sim.walking.planar import clamp


@dataclass(frozen=True, slots=True)
class WalkingLimits:
    """Limits of a commanded velocity; faster commands are clamped, slower ones than the deadband mean standing."""

    forward: float = 0.40  # m/s
    backward: float = 0.20  # m/s
    sideways: float = 0.12  # m/s
    turn: float = 0.45  # rad/s
    linear_deadband: float = 0.004  # m/s; slower than this is standing
    turn_deadband: float = 0.008  # rad/s


def walkable_velocity(vx: float, vy: float, wz: float, limits: WalkingLimits) -> Velocity | None:
    """Clamp each component (m/s, m/s, rad/s) to the limits; None means standing.

    Raises:
        ValueError: a component is not a finite number.
    """
    if not (math.isfinite(vx) and math.isfinite(vy) and math.isfinite(wz)):
        raise ValueError(f"velocity is ({vx}, {vy}, {wz}); expected finite numbers in m/s, m/s and rad/s")
    if math.hypot(vx, vy) < limits.linear_deadband and abs(wz) < limits.turn_deadband:
        return None
    return Velocity(
        clamp(vx, -limits.backward, limits.forward),
        clamp(vy, -limits.sideways, limits.sideways),
        clamp(wz, -limits.turn, limits.turn),
    )
