"""The repair of rclpy's executors: a spin goes on when another thread destroys a subscription."""

import pytest
from rclpy_process import run_scenario

from ros_runtime.workarounds.rclpy_repairs.destroyed_handler import needs_repair
from ros_runtime.workarounds.rclpy_repairs.version import installed_version


def end_of_spin(repairs):
    done = run_scenario("destroying_scenarios.py", "subscriptions_are_destroyed", repairs)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_a_spin_goes_on_while_subscriptions_are_destroyed():
    assert end_of_spin("on") == ""


@pytest.mark.skipif(not needs_repair(installed_version()), reason="this rclpy does not have the fault")
def test_without_the_repair_the_spin_ends():
    assert end_of_spin("off") == "InvalidHandle", "is the repair still needed?"
