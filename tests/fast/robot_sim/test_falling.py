"""Pushes, falls and motor power."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bench.robot.trial import simulate
from g1 import ROBOTS
from robot_sim.humanoid import Humanoid
from robot_sim.state import Mode


@pytest.fixture
def humanoid(request: pytest.FixtureRequest) -> Humanoid:
    robot = Humanoid(robot=getattr(request, "param", "humanoid"))
    simulate(robot, 0.5)
    return robot


on_both_robots = pytest.mark.parametrize("humanoid", ROBOTS, indirect=True)


@on_both_robots
@pytest.mark.parametrize("direction", np.linspace(0, 2 * math.pi, 4, endpoint=False))
def test_it_catches_a_push_of_10_newton_seconds(humanoid, direction):
    humanoid.push((10 * math.cos(direction), 10 * math.sin(direction), 0.0))
    simulate(humanoid, 3.0)
    assert humanoid.mode is Mode.STANDING
    assert humanoid.up() > 0.99


def test_a_push_moves_it_by_its_impulse(humanoid):
    humanoid.set_motor_power(False)
    humanoid.data.qvel[:] = 0.0
    humanoid.model.opt.gravity[:] = 0.0
    humanoid.push((0.0, 0.0, 19.0), duration=0.05)
    simulate(humanoid, 0.1)
    momentum = 38.0 * humanoid.data.sensor("com_velocity").data
    assert momentum == pytest.approx([0.0, 0.0, 19.0], abs=0.5)


@on_both_robots
def test_after_a_fall_it_stays_down(humanoid):
    humanoid.push((80.0, 20.0, 0.0))
    simulate(humanoid, 2.0, until=lambda: humanoid.mode is Mode.FALLEN)
    for _ in range(200):
        humanoid.step()
    assert humanoid.mode is Mode.FALLEN
    assert humanoid.up() < 0.6 or humanoid.base_pose().position[2] < humanoid.body.fallen_height
    assert not humanoid.motors_enabled
    assert not humanoid.joint_state().effort.any()
    humanoid.set_motor_power(True)
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    for _ in range(200):
        humanoid.step()
    assert humanoid.mode is Mode.FALLEN
    assert not humanoid.motors_enabled


@pytest.mark.parametrize("seconds", [1.6, 2.0, 2.2])
def test_without_power_a_walking_robot_falls_like_a_stone_and_then_sits_on_its_legs(humanoid, seconds):
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    simulate(humanoid, seconds)
    humanoid.set_motor_power(False)
    began, height = humanoid.time, humanoid.base_pose().position[2]
    for duration, most in ((0.1, 0.01), (0.1, 0.04)):  # s, m above the stone
        simulate(humanoid, duration)
        stone = height - 9.81 / 2 * (humanoid.time - began) ** 2
        assert -0.005 < humanoid.base_pose().position[2] - stone < most
    simulate(humanoid, 0.1)
    assert humanoid.base_pose().position[2] > 0.24  # the stone is at 0.16 m


@on_both_robots
def test_without_motor_power_it_collapses_and_falls(humanoid):
    humanoid.set_motor_power(False)
    humanoid.step()
    assert humanoid.mode is Mode.OFF
    assert not humanoid.motors_enabled
    assert not humanoid.joint_state().effort.any()
    simulate(humanoid, 3.0)
    assert humanoid.mode is Mode.FALLEN


def test_power_cut_mid_stride_makes_it_fall(humanoid):
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    simulate(humanoid, 2.0)
    humanoid.set_motor_power(False)
    simulate(humanoid, 3.0)
    assert humanoid.mode is Mode.FALLEN


def test_power_that_returns_in_time_saves_it(humanoid):
    humanoid.walk_velocity(0.2, 0.0, 0.0)
    simulate(humanoid, 1.5)
    humanoid.stop()
    simulate(humanoid, 2.0)
    steps = humanoid.steps
    humanoid.set_motor_power(False)
    simulate(humanoid, 0.1)
    assert humanoid.base_pose().position[2] < 0.58
    humanoid.set_motor_power(True)
    simulate(humanoid, 3.0)
    assert humanoid.mode is Mode.STANDING
    assert humanoid.base_pose().position[2] == pytest.approx(0.6, abs=0.01)
    assert humanoid.steps >= steps > 0


def test_commands_without_power_are_ignored(humanoid):
    humanoid.set_motor_power(False)
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    humanoid.set_motor_power(True)
    simulate(humanoid, 2.0)
    assert humanoid.mode is Mode.STANDING
    assert humanoid.steps == 0


@pytest.mark.parametrize(
    ("impulse", "duration", "message"),
    [
        ((1.0, 2.0), 0.1, "three finite numbers"),
        ((math.nan, 0.0, 0.0), 0.1, "three finite numbers"),
        ((1.0, 0.0, 0.0), 0.0, "more than 0 s"),
    ],
)
def test_an_invalid_push_is_refused(humanoid, impulse, duration, message):
    with pytest.raises(ValueError, match=message):
        humanoid.push(impulse, duration)
