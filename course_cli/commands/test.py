"""`course test`: the whole test suite."""

from __future__ import annotations

import subprocess
import sys

import typer

from ros_runtime.project import PROJECT


def test(context: typer.Context) -> None:
    """Run the test suite; further arguments go to pytest, for example `course test tests/setup -x`."""
    # In a child, because pytest's plugins and the ROS libraries both hold on to a process's state. Two files at a
    # time: robots and notebooks of the tests wait for the clock more than for the processors.
    command = [sys.executable, "-m", "pytest", "-n", "2", "--dist", "loadfile", *context.args]
    status = subprocess.run(command, cwd=PROJECT).returncode
    raise typer.Exit(0 if status == 0 else 1)
