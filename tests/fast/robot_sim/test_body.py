"""Crouching, rising, and the gains of the balance controller."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from bench.robot.trial import simulate
from robot_sim.humanoid import Humanoid
from robot_sim.state import Mode
from robot_sim.walking.balance_gains import BalanceGains

CROUCH, STANCE = 0.45, 0.60  # m


@pytest.fixture
def humanoid() -> Humanoid:
    robot = Humanoid()
    simulate(robot, 0.3)
    return robot


def height(humanoid: Humanoid) -> float:
    return float(humanoid.base_pose().position[2])


def test_it_crouches_and_rises_at_the_commanded_rate(humanoid):
    humanoid.move_body(-0.05)
    simulate(humanoid, 1.0)
    assert height(humanoid) == pytest.approx(STANCE - 0.05, abs=0.01)
    humanoid.move_body(-0.15)
    simulate(humanoid, 2.0)
    assert height(humanoid) == pytest.approx(CROUCH, abs=0.005)
    humanoid.move_body(0.1)
    simulate(humanoid, 2.5)
    assert height(humanoid) == pytest.approx(STANCE, abs=0.005)
    assert (humanoid.mode, humanoid.steps) == (Mode.STANDING, 0)


def test_a_crouch_is_held_against_a_push(humanoid):
    humanoid.reset(height=CROUCH)
    simulate(humanoid, 0.5)
    humanoid.push((0.0, 8.0, 0.0))
    simulate(humanoid, 3.0)
    assert humanoid.mode is Mode.STANDING
    assert height(humanoid) == pytest.approx(CROUCH, abs=0.01)


def test_a_crouching_robot_rises_before_it_walks(humanoid):
    humanoid.reset(height=CROUCH)
    humanoid.walk_to(0.4, 0.0, 0.0)
    simulate(humanoid, 0.5)
    assert (humanoid.mode, humanoid.steps) == (Mode.STANDING, 0)
    assert simulate(humanoid, 8.0, until=lambda: humanoid.arrived)
    assert height(humanoid) == pytest.approx(STANCE, abs=0.01)


def test_a_stop_before_it_has_risen_cancels_the_walk(humanoid):
    humanoid.reset(height=CROUCH)
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    simulate(humanoid, 0.2)
    humanoid.stop()
    simulate(humanoid, 3.0)
    assert (humanoid.mode, humanoid.steps) == (Mode.STANDING, 0)


def test_while_it_walks_it_does_not_crouch(humanoid):
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    simulate(humanoid, 1.0)
    humanoid.move_body(-0.15)
    simulate(humanoid, 2.0)
    assert humanoid.mode is Mode.WALKING
    assert height(humanoid) > 0.57


def test_a_rate_that_is_not_finite_is_refused(humanoid):
    with pytest.raises(ValueError, match="expected a finite number"):
        humanoid.move_body(math.nan)


@pytest.mark.parametrize("share", [0.5, 2.0, 8.0])
def test_suitable_gains_keep_the_robot_upright(humanoid, share):
    humanoid.balance_gains = scaled(humanoid.balance_gains, share)
    humanoid.push((0.0, 8.0, 0.0))
    simulate(humanoid, 3.0)
    humanoid.walk_velocity(0.3, 0.0, 0.1)
    simulate(humanoid, 3.0)
    assert humanoid.mode is Mode.WALKING


@pytest.mark.parametrize("share", [0.0, 32.0])
def test_gains_that_are_too_weak_or_too_stiff_make_it_fall(humanoid, share):
    humanoid.balance_gains = scaled(humanoid.balance_gains, share)
    humanoid.push((0.0, 8.0, 0.0))
    simulate(humanoid, 6.0)
    assert humanoid.mode is Mode.FALLEN


def test_weaker_gains_let_it_lean_further(humanoid):
    def lean(share: float) -> float:
        robot = Humanoid()
        robot.balance_gains = scaled(robot.balance_gains, share)
        simulate(robot, 0.3)
        robot.push((0.0, 6.0, 0.0))
        lowest = 1.0
        for _ in range(100):
            robot.step()
            lowest = min(lowest, robot.up())
        return math.acos(lowest)

    assert lean(0.25) > 1.5 * lean(1.0) > 1.5 * lean(4.0)


def test_reset_restores_the_gains(humanoid):
    before = humanoid.balance_gains
    humanoid.balance_gains = scaled(before, 2.0)
    humanoid.reset()
    assert humanoid.balance_gains == before


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        ({"kp_pitch": -1.0}, "kp_pitch is -1.0"),
        ({"kd_roll": math.nan}, "kd_roll is nan"),
        ({"max_torque": 0.0}, "max_torque is 0"),
    ],
)
def test_invalid_gains_are_refused(humanoid, fault, message):
    with pytest.raises(ValueError, match=message):
        replace(humanoid.balance_gains, **fault)


def scaled(gains: BalanceGains, share: float) -> BalanceGains:
    return BalanceGains(
        *(share * value for value in (gains.kp_pitch, gains.kd_pitch, gains.kp_roll, gains.kd_roll)),
        max_torque=gains.max_torque,
    )
