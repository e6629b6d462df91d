"""What the gait asks of the body in one tick."""

from typing import NamedTuple

from robot_sim.walking.dcm_plan import Point
from robot_sim.walking.swing import SwingReference


class BalanceTask(NamedTuple):
    """The gait's wish for the next tick; world frame."""

    cop: Point  # m, centre of pressure that moves the DCM as planned
    yaw: float  # rad, heading of the body
    left_share: float | None = None  # of the load; None: as the CoP has it
    swing: SwingReference | None = None  # of the foot in the air, if any
