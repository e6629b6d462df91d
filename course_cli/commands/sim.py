"""`course sim`: runs the robot node alone."""

from __future__ import annotations

import os
import sys

import typer


def sim(context: typer.Context) -> None:
    """Run the robot node with all options, including --help."""
    # The node replaces this process, so that it receives the signals and sets the exit status.
    os.execv(sys.executable, [sys.executable, "-m", "robot_sim", *context.args])
