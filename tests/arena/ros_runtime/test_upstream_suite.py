"""`course bench --upstream` with tests that are known: what the course spoils is named, and nothing else."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from ros_runtime.workarounds.scaled_clock import library_path

COURSE = Path(sys.executable).with_name("course")
# The names are those of files that upstream has.
SOUND = """
import os, time
import pytest, rclpy
from test_msgs.msg import Empty


def test_a_message_arrives():
    rclpy.init()
    node, heard = rclpy.create_node("node"), []
    node.create_subscription(Empty, "topic", heard.append, 1)
    publisher = node.create_publisher(Empty, "topic", 1)
    while not heard:
        publisher.publish(Empty())
        rclpy.spin_once(node, timeout_sec=0.1)
    rclpy.shutdown()


def test_fails_everywhere():
    assert False


@pytest.mark.skip
def test_skipped(): ...


def test_this_process_is_repaired_as_its_mode_says():
    from rclpy.executors import MultiThreadedExecutor
    repaired = "ros_runtime" in MultiThreadedExecutor._spin_once_impl.__module__
    assert repaired == (os.environ.get("RCLPY_REPAIRS") != "off")
"""
SPOILT = """
import os, time
from ros_runtime.workarounds.scaled_clock.clock import real_monotonic_ns


def test_real_time_passes():
    before = real_monotonic_ns()
    time.sleep(0.4)
    assert real_monotonic_ns() - before > 300_000_000


def test_without_repairs():
    assert os.environ.get("RCLPY_REPAIRS") == "off"


def test_ends_the_process():
    if os.environ.get("RCLPY_REPAIRS") != "off":
        os._exit(7)
"""
MODES = ["plain", "repaired", "clock at 1", "clock at 5"]


def bench(checkout: Path, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    command = [COURSE, "bench", "--upstream", "--upstream-tests", checkout, *arguments]
    environment = {**os.environ, "COLUMNS": "200"}
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=300)


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    (tmp_path / "checkout/rclpy/test").mkdir(parents=True)
    return tmp_path / "checkout"


@pytest.mark.skipif(not library_path(), reason="the clock's library was not built here")
def test_what_passes_plain_and_with_all_the_course_changes_is_counted(checkout: Path, tmp_path: Path) -> None:
    (checkout / "rclpy/test/test_executor.py").write_text(SOUND)
    ran = bench(checkout, "--json", tmp_path / "out.json")

    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "All that passes plain passes" in ran.stdout
    files = json.loads((tmp_path / "out.json").read_text())["files"]
    assert [file["mode"] for file in files] == MODES
    for file in files:
        assert (file["passed"], file["failed"], file["skipped"], file["ended"]) == (2, 1, 1, None)


@pytest.mark.skipif(not library_path(), reason="the clock's library was not built here")
def test_what_the_course_spoils_is_named_and_costs_the_status(checkout: Path, tmp_path: Path) -> None:
    (checkout / "rclpy/test/test_executor.py").write_text(SPOILT)
    ran = bench(checkout, "--json", tmp_path / "out.json")

    assert ran.returncode == 1
    differences = json.loads((tmp_path / "out.json").read_text())["differences"]
    assert {(one["test"], one["mode"], one["outcome"]) for one in differences} == {
        ("test_real_time_passes", "clock at 5", "failed"),
        *(("test_without_repairs", mode, "failed") for mode in MODES[1:]),
        *(("test_ends_the_process", mode, "not run") for mode in MODES[1:]),
    }
    assert "status 7" in ran.stdout


def test_a_folder_without_tests_says_what_is_expected(tmp_path: Path) -> None:
    ran = bench(tmp_path)
    assert ran.returncode == 1
    assert "git clone --branch jazzy https://github.com/ros2/rclpy" in ran.stdout
