"""The interface between gait and whole-body controller."""

from __future__ import annotations

from typing import NamedTuple

from robot_sim.walking.dcm_plan import Point
from robot_sim.walking.swing import SwingReference


class BalanceTask(NamedTuple):
    """What the gait asks of the body for the next tick; world frame."""

    cop: Point  # m, centre of pressure that moves the DCM as planned
    yaw: float  # rad, heading of the body
    left_share: float | None = None  # of the load; None: as the CoP has it
    swing: SwingReference | None = None  # of the foot in the air, if any
