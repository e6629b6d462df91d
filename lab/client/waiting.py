"""Waits for a condition, with a time limit."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

PERIOD = 0.02  # s between two evaluations of the condition


def becomes_true(condition: Callable[[], Any], timeout: float) -> bool:
    """Wait until `condition()` is true; return False if it is still false after `timeout` s."""
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() >= deadline:
            return False
        time.sleep(PERIOD)
    return True
