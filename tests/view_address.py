"""Finds the address of the robot's view in the output of a program that a test has started."""

from __future__ import annotations

import subprocess
import threading

PREFIX = "view: "  # of the line with the address


def view_address(process: subprocess.Popen[str], within: float) -> str:
    """Read the program's output until it prints the view's address; "" if it ends first. Kill it after `within` s."""
    assert process.stdout
    limit = threading.Timer(within, process.kill)
    limit.start()
    try:
        return next((line.split()[1] for line in process.stdout if line.startswith(PREFIX)), "")
    finally:
        limit.cancel()
