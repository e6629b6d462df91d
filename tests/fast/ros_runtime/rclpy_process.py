"""Runs Python with the environment that the lab and the arena give their nodes."""

import os
import subprocess
import sys
from pathlib import Path

from ros_runtime.environment import ros_environment


def run_python(*arguments, **variables):
    """Run it to its end; returns the finished process."""
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        env=os.environ | ros_environment() | variables,
        capture_output=True,
        text=True,
        timeout=60,
    )


def run_scenario(script, name, repairs="on"):
    """Run one scenario of a script beside the tests, in a network of its own where that is possible."""
    domain = str(os.getpid() % 100 + 1)
    return run_python(Path(__file__).with_name(script), name, RCLPY_REPAIRS=repairs, ROS_DOMAIN_ID=domain)
