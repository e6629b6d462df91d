"""Repair of rclpy.experimental's EventsExecutor, which in the wheels runs no callback and ignores Ctrl-C.

What happens. `spin()`, and every other spin without a timeout, takes a whole processor and never returns.

Why. Without a timeout the executor waits until steady_clock's maximum (`EventsQueue::Run`). If libstdc++ is compiled
for a glibc before 2.30, which has no pthread_cond_clockwait, it converts that time to the system clock, and the
addition overflows to a negative time. pthread_cond_timedwait rejects that (EINVAL) before it unlocks the mutex, so the
executor calls it again and again, and no event can enter the executor's queue.

The repair. A spin without a timeout gets a timeout of thirty years.
"""

from __future__ import annotations

from functools import wraps
from pathlib import Path
from types import ModuleType
from typing import Any

_LONGEST_TIMEOUT = 1e9  # s; does not overflow when it is added to the present system time


def needs_repair(library: Path) -> bool:
    """Return whether rclpy's compiled module was made for a glibc without pthread_cond_clockwait."""
    return b"pthread_cond_clockwait" not in library.read_bytes()


def repair(compiled: ModuleType) -> None:
    """Change the class EventsExecutor of rclpy's compiled module in place."""
    from rclpy.task import Future

    cls = compiled.EventsExecutor
    once, until, once_until = (
        cls.spin_once,
        cls.spin_until_future_complete,
        cls.spin_once_until_future_complete,
    )

    @wraps(cls.spin)
    def spin(self: Any) -> None:
        until(self, Future(), _LONGEST_TIMEOUT)

    @wraps(once)
    def spin_once(self: Any, timeout_sec: float | None = None) -> None:
        once(self, _finite(timeout_sec))

    @wraps(until)
    def spin_until_future_complete(self: Any, future: Any, timeout_sec: float | None = None) -> None:
        until(self, future, _finite(timeout_sec))

    @wraps(once_until)
    def spin_once_until_future_complete(self: Any, future: Any, timeout_sec: float | None = None) -> None:
        once_until(self, future, _finite(timeout_sec))

    for method in (spin, spin_once, spin_until_future_complete, spin_once_until_future_complete):
        setattr(cls, method.__name__, method)


def _finite(timeout_sec: float | None) -> float:
    return _LONGEST_TIMEOUT if timeout_sec is None else timeout_sec
