"""Repair of rclpy's MultiThreadedExecutor, which in some versions takes a whole core while callbacks wait.

What happens. A node has a subscription and a callback that sleeps, such as an action's execute loop. At times the
spinning thread takes a whole core and the callbacks starve: feedback that should have 5 Hz has 0.5 Hz
(ros2/rclpy#1452).

Why. The spinning thread submits each ready handler to a pool of workers and waits again at once. Until a worker
has taken the message, the subscription stays out of the wait set, but its QoS event handlers remain in it.
They share the reader's status condition, which the unread message keeps triggered. So each wait returns at
once with nothing to do, and each time the spinning thread gets the interpreter lock before the worker that should
take the message. There is a second fault: a handler that still waits in the pool counts as idle, so the executor
submits it again and again. Upstream has repaired only this second fault (ros2/rclpy#1547).

The repair. The executor does not wait again before a worker has taken over every submitted handler. A new handler
is taken over when it has taken its message or found none, a resumed coroutine when it runs again. So while all
workers are busy, the spinning thread sleeps; no further handler could start anyway. Every 50 ms it checks whether
it has to stop.
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
# 7.1.12 was released before anybody requested a backport of #1547 to Jazzy.
FIRST_REPAIRED = (7, 1, 13)

_STOP_CHECK_PERIOD = 0.05  # s between two checks for shutdown and of the caller's condition
_SHORTEST_TIMEOUT = 0.001  # s; gives the workers the interpreter lock even if the caller's timeout is 0


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

    This class uses a plain lock in `with` statements and a SimpleQueue. threading's events and conditions can stay
    locked if KeyboardInterrupt is raised in the thread that uses them, and then the workers never end.
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
        """Record that `task` is submitted to the pool; return False if it is already there."""
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
        """Wait until workers have taken over all handlers or `should_stop()`; False if `timeout_sec` passes first."""
        timeout = math.inf
        if timeout_sec is not None and timeout_sec >= 0:
            timeout = max(timeout_sec, _SHORTEST_TIMEOUT)
        end = time.monotonic() + timeout
        while self._submitted:
            try:
                self._all_done.get(timeout=min(_STOP_CHECK_PERIOD, max(end - time.monotonic(), 0.0)))
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
        """Run `task`, unless it is already waiting in the pool."""
        return super().submit(self._run, task) if self._takeovers.submitted(task) else None

    def _run(self, task: Any) -> None:
        self._takeovers.started(task)
        try:
            task()
        finally:
            self._takeovers.done(task)
