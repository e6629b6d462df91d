"""The interface between gait and whole-body controller."""

from __future__ import annotations

from typing import NamedTuple

from robot_sim.walking.dcm_plan import Point
from robot_sim.walking.swing import SwingReference


class BalanceTask(NamedTuple):
    """The task of the whole-body controller for the next tick; world frame."""

    cop: Point  # m, centre of pressure that moves the DCM as planned
    yaw: float  # rad, heading of the body
    left_share: float | None = None  # share of the load on the left foot; None: computed from the CoP
    swing: SwingReference | None = None  # of the foot in the air, if any
