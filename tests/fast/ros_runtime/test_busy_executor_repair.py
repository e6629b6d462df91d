"""The repair of the MultiThreadedExecutor: it is applied where needed, it works, and it changes nothing else."""

import json
import shutil
from pathlib import Path

import pytest
from rclpy_process import run_python, run_scenario

import ros_runtime
from ros_runtime.workarounds import rclpy_repairs
from ros_runtime.workarounds.rclpy_repairs.busy_executor import needs_repair
from ros_runtime.workarounds.rclpy_repairs.version import installed_version

PTH = Path(rclpy_repairs.__file__).with_name("humanoid_course_rclpy_repairs.pth")
IS_REPAIRED = "import rclpy.executors as e; print(hasattr(e.MultiThreadedExecutor(), '_takeovers'))"

affected = pytest.mark.skipif(
    not needs_repair(installed_version()), reason=f"rclpy {installed_version()} does not have the fault"
)


def python(*arguments, **variables):
    done = run_python(*arguments, **variables)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip(), done.stderr


def run(name, repairs="on"):
    done = run_scenario("executor_scenarios.py", name, repairs)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("version", ["7.1.0", "7.1.5", "7.1.12"])
def test_affected_versions_are_repaired(version):
    assert needs_repair(version)


@pytest.mark.parametrize("version", ["3.3.11", "7.1.13", "7.2.0", "9.1.2", "10.0.4"])
def test_other_versions_are_not_changed(version):
    assert not needs_repair(version)


@affected
def test_every_process_of_the_environment_has_the_repair():
    assert python("-c", f"import rclpy; rclpy.init(); {IS_REPAIRED}")[0] == "True"


def test_a_newer_rclpy_is_not_touched():
    code = (
        "import ros_runtime.workarounds.rclpy_repairs.version as v; v.installed_version = lambda: '7.1.13'\n"
        f"import rclpy; rclpy.init(); {IS_REPAIRED}"
    )
    assert python("-c", code)[0] == "False"


def test_python_starts_without_output_if_ros_runtime_is_missing(tmp_path):
    shutil.copy(PTH, tmp_path)
    output, errors = python(
        *("-I", "-S", "-c", f"import site; site.addsitedir({str(tmp_path)!r}); print('started')")
    )
    assert output == "started"
    assert errors == ""


def test_starting_python_imports_nothing_heavy(tmp_path):
    shutil.copy(PTH, tmp_path)
    (tmp_path / "checkout.pth").write_text(f"{Path(ros_runtime.__file__).parents[1]}\n")
    code = (
        "import sys; before = set(sys.modules); import site; site.addsitedir(sys.argv[1]);"
        "print(*sorted(set(sys.modules) - before - {'site'}))"
    )
    imported = set(python("-I", "-S", "-c", code, tmp_path)[0].split())
    assert {name for name in imported if "ros" in name} == {
        "ros_runtime",
        "ros_runtime.workarounds",
        "ros_runtime.workarounds.rclpy_repairs",
        "ros_runtime.workarounds.rclpy_repairs.hook",
    }
    assert len(imported) < 20, imported


@affected
def test_the_spinning_thread_sleeps_while_all_workers_are_busy_and_messages_arrive():
    repaired = run("all_workers_sleep_while_messages_arrive")
    assert repaired["load"] < 0.15
    assert repaired["received"] == 20
    faulty = run("all_workers_sleep_while_messages_arrive", repairs="off")
    assert faulty["load"] > 4 * repaired["load"], "this rclpy does not spin: is the repair still needed?"


def test_spin_once_keeps_its_timeout_while_all_workers_are_busy():
    assert run("spin_once_with_a_timeout_returns_though_all_workers_sleep")["elapsed"] < 3.0


def test_shutdown_ends_the_spin_while_all_workers_are_busy():
    outcome = run("shutdown_ends_the_spin_though_all_workers_sleep")
    assert outcome["ended"]
    assert outcome["elapsed"] < 3.0


def test_a_callback_that_raises_still_ends_the_spin():
    assert run("a_callback_that_raises_ends_the_spin") == {"raised": "a student's mistake"}


def test_an_async_callback_can_await_a_service_of_its_own_node():
    outcome = run("an_async_callback_awaits_a_service_of_the_same_node")
    assert outcome["answers"] == ["answered"] * 10
