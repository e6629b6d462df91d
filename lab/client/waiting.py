"""Waits for conditions, with a time limit."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from lab.errors import NotInTimeError

PERIOD = 0.02  # s between two evaluations of the condition


def wait_until(condition: Callable[[], Any], timeout: float = 10.0, what: str = "the condition") -> None:
    """Block until `condition()` is true; `what` names the condition in the error.

    Raises NotInTimeError after `timeout` s.
    """
    if not becomes_true(condition, timeout):
        raise NotInTimeError(f"{what}: not within {timeout:g} s")


def becomes_true(condition: Callable[[], Any], timeout: float) -> bool:
    """Wait until `condition()` is true; return False if it is still false after `timeout` s."""
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() >= deadline:
            return False
        time.sleep(PERIOD)
    return True
