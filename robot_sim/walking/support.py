"""The limits within which the feet can produce a centre of pressure (CoP).

Turning the body and swinging a leg also shift the CoP. The whole-body controller reports this as `cop_shift`. The shift
has priority: planned CoPs get the rest of the sole, so that the body stays upright.
"""

from __future__ import annotations

from robot_sim.model.dimensions import Dimensions
from robot_sim.walking.balance_parameters import BalanceParameters
from robot_sim.walking.dcm_plan import Point
from robot_sim.walking.planar import Frame, clamp
from robot_sim.walking.sensing import Sensing


class Support:
    """The part of the soles that planned CoPs may use, ±length × ±width (m) around a sole's centre."""

    def __init__(self, size: Dimensions, balance: BalanceParameters) -> None:
        self.length = size.sole_half_length * balance.sole_length_share
        self.width = size.sole_half_width * balance.sole_width_share

    def on_sole(self, cop: Point, sole: Frame) -> Point:
        """Return the nearest CoP within a sole."""
        return sole.clamped(cop[0], cop[1], self.length, self.width)

    def on_stance_foot(self, cop: Point, sole: Frame, cop_shift: Point) -> Point:
        """Return the nearest CoP within the stance foot's sole, with room for the shift."""
        shift_x, shift_y = sole.local(sole.x + cop_shift[0], sole.y + cop_shift[1])
        shift_x = clamp(shift_x, -self.length, self.length)
        shift_y = clamp(shift_y, -self.width, self.width)
        x, y = sole.local(*cop)
        return sole.world(
            clamp(x, -self.length - shift_x, self.length - shift_x),
            clamp(y, -self.width - shift_y, self.width - shift_y),
        )

    def in_transfer(self, cop: Point, sensed: Sensing, yaw: float, left_share: float) -> Point:
        """Return the nearest CoP within a sole's size around the point between the feet that fits the load split."""
        left, right = sensed.soles
        x = left_share * left[0] + (1 - left_share) * right[0]
        y = left_share * left[1] + (1 - left_share) * right[1]
        return self.on_sole(cop, Frame(x, y, yaw))

    def between_feet(self, cop: Point, sensed: Sensing, cop_shift: Point) -> Point:
        """Return the nearest CoP around the line between the feet, with room for the fore-aft shift."""
        left, right = sensed.soles
        line_x, line_y = left[0] - right[0], left[1] - right[1]
        share = left_share_of(cop, sensed)
        axis = Frame(right[0] + share * line_x, right[1] + share * line_y, sensed.feet_centre[2])
        shift, _ = axis.local(axis.x + cop_shift[0], axis.y + cop_shift[1])
        shift = clamp(shift, -self.length, self.length)
        x, y = axis.local(*cop)
        return axis.world(
            clamp(x, -self.length - shift, self.length - shift), clamp(y, -self.width, self.width)
        )


def left_share_of(cop: Point, sensed: Sensing) -> float:
    """Return the left foot's share of the load (0 to 1) for a CoP, projected on the line between the feet."""
    left, right = sensed.soles
    line_x, line_y = left[0] - right[0], left[1] - right[1]
    along = (cop[0] - right[0]) * line_x + (cop[1] - right[1]) * line_y
    return clamp(along / (line_x * line_x + line_y * line_y), 0.0, 1.0)
