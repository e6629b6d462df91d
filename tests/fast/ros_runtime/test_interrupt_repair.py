"""The repair of Ctrl-C: a correct node ends with status 0 at whatever moment the interrupt comes."""

import pytest
from rclpy_process import run_scenario

from ros_runtime.workarounds.rclpy_repairs.interrupt import needs_repair
from ros_runtime.workarounds.rclpy_repairs.version import installed_version

SCENARIOS = "interrupt_scenarios.py"
# The errors without the repair. A daemon thread crashes only in about half of the runs.
FAULTS = {
    "between_the_look_at_the_context_and_the_wait_set": "failed to initialize wait set",
    "while_a_message_is_made": "Unable to convert call argument",
    "while_a_callback_publishes": "context is invalid",
    "inside_try_shutdown": "rcl_shutdown already called",
}


@pytest.mark.parametrize(
    ("version", "affected"), [("7.1.0", True), ("7.1.20", True), ("3.3.11", False), ("9.1.2", False)]
)
def test_only_the_versions_of_jazzy_are_repaired(version, affected):
    assert needs_repair(version) is affected


@pytest.mark.parametrize("scenario", [*FAULTS, "while_a_daemon_thread_spins"])
def test_a_correct_node_ends_with_status_0(scenario):
    done = run_scenario(SCENARIOS, scenario)
    assert done.returncode == 0, done.stderr


@pytest.mark.skipif(not needs_repair(installed_version()), reason="this rclpy is not repaired")
@pytest.mark.parametrize("scenario", FAULTS)
def test_without_the_repair_the_node_fails(scenario):
    done = run_scenario(SCENARIOS, scenario, repairs="off")
    assert FAULTS[scenario] in done.stderr, "is the repair still needed?"
    assert done.returncode == 1
