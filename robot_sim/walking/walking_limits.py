"""From the velocity someone asks for to one the robot can walk."""

import math
from dataclasses import dataclass

from robot_sim.walking.footsteps import Velocity
from robot_sim.walking.planar import clamp


@dataclass(frozen=True, slots=True)
class WalkingLimits:
    """What ``walk_velocity`` accepts; a faster command is walked at the limit."""

    forward: float = 0.40  # m/s
    backward: float = 0.20  # m/s
    sideways: float = 0.12  # m/s
    turn: float = 0.45  # rad/s
    linear_deadband: float = 0.004  # m/s; slower than this is standing
    turn_deadband: float = 0.008  # rad/s


def walkable_velocity(vx: float, vy: float, wz: float, limits: WalkingLimits) -> Velocity | None:
    """The velocity (m/s, m/s, rad/s) within the limits, each by itself; None when it means standing.

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
