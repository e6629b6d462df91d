"""Repair of rclpy.experimental's EventsExecutor, which in the wheels runs no callback and ignores Ctrl-C.

What happens. `spin()`, and every other spin without a timeout, takes a whole processor and never returns.

Why. Without a timeout the executor waits until steady_clock's last moment (`EventsQueue::Run`). Compiled for a glibc
without pthread_cond_clockwait, which came with 2.30, libstdc++ converts that moment to the system clock, and the sum
overflows. pthread_cond_timedwait refuses a negative time before it unlocks the mutex (EINVAL), so the executor asks
again and again, and no event can be put into its queue.

The repair. A spin without a timeout gets one of thirty years.
"""

from __future__ import annotations

from functools import wraps
from pathlib import Path
from types import ModuleType
from typing import Any

_FOR_EVER = 1e9  # s; added to today's system time it does not overflow


def needs_repair(library: Path) -> bool:
    """Return whether rclpy's compiled module was made for a glibc in which only the system clock can be waited on."""
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
        until(self, Future(), _FOR_EVER)

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
    return _FOR_EVER if timeout_sec is None else timeout_sec
