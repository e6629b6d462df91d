"""Calls a student's `wait_for_end` with a child that lasts, and prints as JSON what it did.

The reason to stop comes without a cancel of the goal, as a low battery or a newer goal does.
"""

from __future__ import annotations

import json
import os
import sys
import threading
import time
from importlib import import_module
from typing import Any

import rclpy
from rclpy.task import Future

REASON_DELAY = 1.0  # s until should_stop() becomes true
CHILD_CANCEL_DURATION = 0.5  # s that the child needs to end after a cancel request
WORK_TIME = 3.0  # s until the child ends without a cancel request
MAX_WAIT = 6.0  # s


class ChildEnd(Future):
    """The future of the child's result, which counts how often it is asked whether the child has ended."""

    calls_of_done = 0

    def done(self) -> bool:
        """Count the call, and return whether the child has ended."""
        self.calls_of_done += 1
        return super().done()


class Child:
    """A goal handle of the child that records the cancel requests."""

    accepted = True

    def __init__(self, end: ChildEnd) -> None:
        self.cancels: list[str] = []
        self._end = end

    def cancel_goal_async(self) -> Future:
        """Record the cancel request, and end soon after it."""
        response: Future = Future()
        self._cancel("cancel_goal_async", response)
        return response

    def cancel_goal(self) -> None:
        """Record the cancel request, and block until its response as rclpy's method does."""
        self._cancel("cancel_goal")
        time.sleep(CHILD_CANCEL_DURATION)

    def _cancel(self, method: str, *futures: Future) -> None:
        self.cancels.append(method)
        for future in (*futures, self._end):
            end_later(future, CHILD_CANCEL_DURATION)


class GoalHandle:
    """The errand's goal, which nobody cancels."""

    is_cancel_requested = False
    is_active = True


def end_later(future: Future, delay: float) -> None:
    """Complete a future after `delay` s."""
    timer = threading.Timer(delay, future.set_result, [None])
    timer.daemon = True
    timer.start()


def main() -> None:
    """Call wait_for_end, and print its cancel requests, how often it asked whether to go on, and how long it took."""
    sys.path.insert(0, os.getcwd())
    rclpy.init()
    errand = import_module("careful_errand").CarefulErrand()
    end = ChildEnd()
    child = Child(end)
    calls_of_should_stop = 0
    started = time.monotonic()

    def should_stop(goal_handle: Any) -> bool:
        nonlocal calls_of_should_stop
        calls_of_should_stop += 1
        return time.monotonic() > started + REASON_DELAY

    errand.should_stop = should_stop
    end_later(end, WORK_TIME)
    waiting = threading.Thread(target=errand.wait_for_end, args=(GoalHandle(), child, end), daemon=True)
    waiting.start()
    waiting.join(MAX_WAIT)
    saw = {
        "cancels": child.cancels,
        "calls_of_should_stop": calls_of_should_stop,
        "calls_of_done": end.calls_of_done,
        "seconds": time.monotonic() - started,
    }
    print(json.dumps(saw), flush=True)
    os._exit(0)  # the student's thread may still be waiting


if __name__ == "__main__":
    main()
