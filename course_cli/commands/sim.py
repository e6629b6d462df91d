"""`course sim`: the robot node alone."""

from __future__ import annotations

import os
import sys

import typer


def sim(context: typer.Context) -> None:
    """Run the robot node; all options go to it, --help too."""
    # The node replaces this process, so that signals and the exit status are its own.
    os.execv(sys.executable, [sys.executable, "-m", "robot_sim", *context.args])
