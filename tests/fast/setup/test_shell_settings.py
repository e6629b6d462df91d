"""The course's commands work in shells with variables for other ROS work."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

import robot_sim.__main__


def run(*arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments], env=os.environ | variables, capture_output=True, text=True, timeout=60
    )


def test_another_middleware_is_ignored_in_every_process() -> None:
    done = run("-c", "import rclpy.node; print('imported')", RMW_IMPLEMENTATION="rmw_cyclonedds_cpp")
    assert done.stdout == "imported\n", done.stderr


def test_ros2_refuses_an_invalid_domain_with_a_message() -> None:
    done = run("-m", "ros_cli", "topic", "list", ROS_DOMAIN_ID="abc")
    assert (done.returncode, done.stdout) == (1, "")
    assert re.fullmatch(r"ROS_DOMAIN_ID is 'abc', expected a number from 0 to 232\.\nNext: .*\n", done.stderr)


@pytest.mark.parametrize("domain", ["233", "-1", "１"])
def test_the_robot_refuses_an_invalid_domain_with_a_message(
    domain: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", domain)
    monkeypatch.setattr(sys, "argv", ["course sim"])
    with pytest.raises(SystemExit, match=f"ROS_DOMAIN_ID is '{domain}', expected a number from 0 to 232"):
        robot_sim.__main__.main()
