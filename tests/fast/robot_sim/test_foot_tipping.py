"""A foot that tips is laid down again by its centre of pressure."""

from __future__ import annotations

import math

import pytest

from robot_sim.walking.floor_slope import FloorSlope
from robot_sim.walking.foot_tipping import TippingParameters, cop_against_tipping

LEVEL = (0.0, 0.0)
STILL = (0.0, 0.0, 0.0)


def leaning(x: float, y: float) -> list[float]:
    """A rotation matrix whose normal leans by (x, y), small angles in rad."""
    return [1.0, 0.0, x, 0.0, 1.0, y, -x, -y, math.sqrt(1 - x * x - y * y)]


def shift(lean: tuple[float, float], spin=STILL, slope=LEVEL) -> tuple[float, float]:
    return cop_against_tipping(leaning(*lean), slope, spin, TippingParameters())


@pytest.mark.parametrize("lean", [(0.0, 0.0), (0.03, -0.03)])
def test_a_sole_that_lies_on_the_floor_is_left_alone(lean):
    assert shift(lean, spin=(1.0, 1.0, 0.0)) == (0.0, 0.0)


def test_the_cop_moves_to_the_raised_side():
    x, y = shift((0.1, 0.0))  # toes down, heel up
    assert x == pytest.approx(-0.05)
    assert y == pytest.approx(0.0)
    x, y = shift((0.0, -0.1))  # the right edge down
    assert (x, y) == (pytest.approx(0.0), pytest.approx(0.05))


def test_a_sole_that_keeps_tipping_gets_a_larger_shift():
    falling, returning = shift((0.1, 0.0), spin=(0.0, 0.5, 0.0)), shift((0.1, 0.0), spin=(0.0, -0.5, 0.0))
    assert falling[0] < shift((0.1, 0.0))[0] < returning[0]


def test_a_sole_on_a_slope_does_not_tip():
    """On a floor that rises ahead, the normal leans back."""
    assert shift((-0.08, 0.0), slope=(0.08, 0.0)) == (0.0, 0.0)


def test_the_slope_estimate_is_filtered_and_bounded():
    slope = FloorSlope(0.005)
    for _ in range(4):
        slope.update(leaning(-0.06, 0.0))
    assert slope.estimate() == (0.0, 0.0)
    for _ in range(400):
        slope.update(leaning(-0.06, 0.0))
    assert slope.estimate() == (pytest.approx(0.06, rel=0.01), pytest.approx(0.0))
    for _ in range(400):
        slope.update(leaning(-0.3, -0.3))
    assert math.hypot(*slope.estimate()) == pytest.approx(0.09)
