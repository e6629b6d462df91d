"""Waiting with an end."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

from lab.errors import NotInTimeError

PERIOD = 0.02  # s between two looks


def wait_until(condition: Callable[[], Any], timeout: float = 10.0, what: str = "the condition") -> None:
    """Block until `condition()` is true. `what` names it in the error.

    Raises NotInTimeError after `timeout` s.
    """
    if not comes_true(condition, timeout):
        raise NotInTimeError(f"{what}: not so within {timeout:g} s")


def comes_true(condition: Callable[[], Any], timeout: float) -> bool:
    """Whether `condition()` is true now or becomes so within `timeout` s."""
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() >= deadline:
            return False
        time.sleep(PERIOD)
    return True


def is_done_within(future: Any, timeout: float) -> bool:
    """Whether a future that another thread completes is done, now or within `timeout` s."""
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    return done.wait(timeout)
