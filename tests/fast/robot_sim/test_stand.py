"""The stand, on which motors can be switched off and on again."""

from __future__ import annotations

import pytest

from bench.robot.trial import simulate
from robot_sim.humanoid import Humanoid
from robot_sim.state import Mode


@pytest.fixture
def humanoid() -> Humanoid:
    robot = Humanoid("stand")
    simulate(robot, 1.0)
    return robot


def positions(humanoid: Humanoid) -> list[float]:
    return humanoid.joint_state().position.tolist()


def test_on_the_stand_it_stands_as_high_as_on_the_floor(humanoid):
    assert humanoid.mode is Mode.STANDING
    assert humanoid.base_pose().position[2] == pytest.approx(0.6, abs=0.01)


def test_without_motor_power_it_hangs_on_the_stand_and_does_not_fall(humanoid):
    before = positions(humanoid)
    humanoid.set_motor_power(False)
    simulate(humanoid, 5.0)
    assert humanoid.mode is Mode.OFF
    assert not humanoid.joint_state().effort.any()
    assert max(abs(stood - hung) for stood, hung in zip(before, positions(humanoid), strict=True)) > 0.2


@pytest.mark.parametrize("pause", [0.1, 0.7, 5.0])
def test_it_stands_again_whenever_power_returns(humanoid, pause):
    for _ in range(2):
        humanoid.set_motor_power(False)
        simulate(humanoid, pause)
        humanoid.set_motor_power(True)
        simulate(humanoid, 3.0)
        assert humanoid.mode is Mode.STANDING
        assert humanoid.up() > 0.95
