"""The repair of the EventsExecutor: it runs callbacks and reacts to Ctrl-C in every spin without a timeout."""

import signal
from pathlib import Path

import pytest
from events_executor_scenarios import WAYS
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy_process import run_scenario

from ros_runtime.workarounds.rclpy_repairs.endless_wait import needs_repair

SCENARIOS = "events_executor_scenarios.py"


@pytest.mark.parametrize("spin", WAYS)
def test_a_sound_node_serves_and_ends_at_ctrl_c(spin):
    done = run_scenario(SCENARIOS, spin)
    assert (done.returncode, done.stdout) == (0, "caught\n"), done.stderr


@pytest.mark.skipif(
    not needs_repair(Path(rclpy_implementation.__file__)), reason="this rclpy does not have the fault"
)
def test_without_the_repair_no_callback_runs():
    done = run_scenario(SCENARIOS, "executor.spin", repairs="off")
    assert done.returncode == -signal.SIGALRM, "is the repair still needed?"
