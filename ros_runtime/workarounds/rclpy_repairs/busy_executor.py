"""Repair of rclpy's MultiThreadedExecutor, which in some versions spins at full load instead of working.

What happens. With a callback that sleeps (an action's execute loop, say) and a subscription, the spinning
thread now and then takes a whole core and the callbacks starve: feedback meant at 5 Hz arrives at 0.5 Hz
(ros2/rclpy#1452).

Why. The thread that spins hands each ready handler to a pool and goes back to waiting at once. Until a worker
has taken the message, the subscription stays out of the wait set, but its QoS event handlers remain in it.
They share the reader's status condition, which the unread message keeps triggered. So the wait returns at
once with nothing to do, again and again, and each time the spinning thread gets hold of the interpreter lock
before the worker that should take the message. Meanwhile the handler that waits in the pool counts as idle
and is submitted over and over; that half is what upstream repaired (ros2/rclpy#1547).

The repair. The executor does not go back to waiting before every handler it submitted has been taken over by
a worker: a fresh handler when it has taken its message or had nothing to take, a resumed coroutine when it
runs again. While all workers are busy it therefore rests, as no further handler could start anyway, and looks
every 50 ms whether it is told to stop.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from queue import Empty, SimpleQueue
from types import ModuleType
from typing import Any

from ros_runtime.workarounds.rclpy_repairs.version import numbers

FIRST_AFFECTED = (7, 1, 0)
# The request to bring #1547 to Jazzy is younger than 7.1.12.
FIRST_REPAIRED = (7, 1, 13)

_LOOK_PERIOD = 0.05  # s between looks at shutdown and at the caller's condition
_LEAST_PATIENCE = 0.001  # s; a caller that never waits still lets the workers have the interpreter lock


def needs_repair(version: str) -> bool:
    """Return whether the MultiThreadedExecutor of this version of rclpy has the fault."""
    return FIRST_AFFECTED <= numbers(version) < FIRST_REPAIRED


def repair(executors: ModuleType) -> None:
    """Change the class MultiThreadedExecutor of the module rclpy.executors in place."""
    cls = executors.MultiThreadedExecutor
    initialise, make_handler, spin_once = cls.__init__, cls._make_handler, cls._spin_once_impl

    def initialise_with_takeovers(self: Any, *args: Any, **kwargs: Any) -> None:
        initialise(self, *args, **kwargs)
        self._takeovers = _Takeovers()
        # The pool made above has not started a thread yet.
        self._executor = _TakeoverPool(self._executor._max_workers, self._takeovers)

    def make_reporting_handler(
        self: Any, entity: Any, node: Any, take_from_wait_list: Callable[[Any], Any]
    ) -> Any:
        def take(entity: Any) -> Any:
            try:
                return take_from_wait_list(entity)
            finally:
                self._takeovers.done(task)

        task = make_handler(self, entity, node, take)
        self._takeovers.expect_take(task)
        return task

    def spin_once_after_takeovers(
        self: Any, timeout_sec: Any = None, wait_condition: Callable[[], bool] = lambda: False
    ) -> None:
        def should_stop() -> bool:
            return self._is_shutdown or not self._context.ok() or wait_condition()

        # spin_until_future_complete wraps its timeout in an object.
        if self._takeovers.wait(getattr(timeout_sec, "timeout", timeout_sec), should_stop):
            spin_once(self, timeout_sec, wait_condition)

    cls.__init__ = initialise_with_takeovers
    cls._make_handler = make_reporting_handler
    cls._spin_once_impl = spin_once_after_takeovers


class _Takeovers:
    """The handlers that were submitted to the pool and that no worker has taken over yet.

    threading's events and conditions can stay locked when KeyboardInterrupt is raised in the thread that uses them,
    and then the workers never end. A plain lock in a with statement and SimpleQueue cannot.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._submitted: set[Any] = set()
        self._to_take: set[Any] = set()
        self._all_done: SimpleQueue[None] = SimpleQueue()

    def expect_take(self, task: Any) -> None:
        """Count `task` as taken over only when it has taken its message, not when it starts."""
        with self._lock:
            self._to_take.add(task)

    def submitted(self, task: Any) -> bool:
        """Note that `task` goes to the pool; False if it is there already."""
        with self._lock:
            if task in self._submitted:
                return False
            self._submitted.add(task)
            return True

    def started(self, task: Any) -> None:
        with self._lock:
            takes = task in self._to_take
        if not takes:
            self.done(task)

    def done(self, task: Any) -> None:
        with self._lock:
            self._to_take.discard(task)
            self._submitted.discard(task)
            if not self._submitted and self._all_done.empty():
                self._all_done.put(None)

    def wait(self, timeout_sec: float | None, should_stop: Callable[[], bool]) -> bool:
        """Wait until all are taken over or the caller has to stop; False if `timeout_sec` passes first."""
        patience = math.inf
        if timeout_sec is not None and timeout_sec >= 0:
            patience = max(timeout_sec, _LEAST_PATIENCE)
        end = time.monotonic() + patience
        while self._submitted:
            try:
                self._all_done.get(timeout=min(_LOOK_PERIOD, max(end - time.monotonic(), 0.0)))
            except Empty:
                if should_stop():
                    return True
                if time.monotonic() >= end:
                    return False
        return True


class _TakeoverPool(ThreadPoolExecutor):
    """A pool that reports when a worker takes over a handler."""

    def __init__(self, max_workers: int, takeovers: _Takeovers) -> None:
        super().__init__(max_workers)
        self._takeovers = takeovers

    def submit(self, task: Any) -> Any:  # type: ignore[override]
        """Run `task`, unless it is waiting to be run already."""
        return super().submit(self._run, task) if self._takeovers.submitted(task) else None

    def _run(self, task: Any) -> None:
        self._takeovers.started(task)
        try:
            task()
        finally:
            self._takeovers.done(task)
