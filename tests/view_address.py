"""Where a program that a test has started shows its robot."""

from __future__ import annotations

import subprocess
import threading

BEGINNING = "view: "  # of the line that says it


def view_address(process: subprocess.Popen[str], within: float) -> str:
    """Read what the program prints until it names its view; "" if it ends before, which it must after `within` s."""
    assert process.stdout
    limit = threading.Timer(within, process.kill)
    limit.start()
    try:
        return next((line.split()[1] for line in process.stdout if line.startswith(BEGINNING)), "")
    finally:
        limit.cancel()
