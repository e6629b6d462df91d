"""The consumption of the robot's battery."""

from __future__ import annotations

import pytest

from bench.robot.trial import simulate
from robot_sim.battery import Battery
from robot_sim.humanoid import Humanoid
from robot_sim.state import Mode


def energy_used(humanoid: Humanoid, seconds: float) -> float:
    before = humanoid.battery.energy_used
    simulate(humanoid, seconds)
    return humanoid.battery.energy_used - before


def test_walking_costs_more_than_standing_and_standing_more_than_lying():
    humanoid = Humanoid()
    simulate(humanoid, 1.0)
    standing = energy_used(humanoid, 3.0)
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    simulate(humanoid, 1.0)
    walking = energy_used(humanoid, 3.0)
    humanoid.set_motor_power(False)
    off = energy_used(humanoid, 0.2) / 0.2 * 3.0
    assert walking > 1.5 * standing > 1.5 * off > 0


def test_a_walk_takes_one_percent_in_half_a_minute_to_a_minute():
    humanoid = Humanoid()
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    simulate(humanoid, 6.0)
    taken = 1.0 - humanoid.battery.percentage
    assert 6.0 / 60 < 100 * taken < 6.0 / 30


def test_current_is_negative_and_voltage_sags_under_load():
    humanoid = Humanoid()
    simulate(humanoid, 2.0)
    standing, resting_voltage = humanoid.battery.current, humanoid.battery.voltage
    humanoid.walk_velocity(0.4, 0.0, 0.0)
    simulate(humanoid, 3.0)
    assert humanoid.battery.current < standing < 0
    assert humanoid.battery.voltage < resting_voltage


def test_voltage_falls_with_charge():
    battery = Battery()
    full = battery.voltage
    battery.set_percentage(0.2)
    assert battery.percentage == 0.2
    assert battery.voltage < full - 5


def test_power_is_voltage_times_current():
    battery = Battery()
    for _ in range(1000):
        battery.discharge(100.0, 0.005)
    assert -battery.voltage * battery.current == pytest.approx(100.0, rel=1e-3)


def test_an_empty_battery_switches_the_motors_off_until_it_is_charged():
    humanoid = Humanoid()
    simulate(humanoid, 0.5)
    humanoid.battery.set_percentage(0.0)
    humanoid.step()
    assert not humanoid.motors_enabled
    assert humanoid.mode is Mode.OFF
    humanoid.set_motor_power(True)
    assert not humanoid.motors_enabled
    humanoid.battery.set_percentage(0.5)
    humanoid.set_motor_power(True)
    simulate(humanoid, 1.0)
    assert humanoid.mode is Mode.STANDING


@pytest.mark.parametrize("percentage", [-0.1, 20.0, float("nan")])
def test_a_percentage_out_of_range_is_refused(percentage):
    with pytest.raises(ValueError, match="expected 0"):
        Battery().set_percentage(percentage)
