"""Repair of rclpy's handling of Ctrl-C while an executor spins.

What happens. A node catches KeyboardInterrupt and ExternalShutdownException around spin(), as it should. Still, it
sometimes ends with another error, or the C++ runtime aborts it.

Why. SIGINT does two things at once: a thread of rclpy shuts the context down, and Python raises KeyboardInterrupt
in the main thread. Each can happen at a moment that rclpy does not expect:

1. Between the check of the context and the creation of the wait set: RCLError "failed to initialize wait set".
2. During the constructor of a message, called by C++ code: pybind11 loses the KeyboardInterrupt and raises
   RuntimeError "Unable to convert call argument".
3. Between try_shutdown()'s check of the context and its shutdown: RCLError "rcl_shutdown already called".
4. While a callback publishes, calls a service or sends a response: RCLError "context is invalid".
5. At the end of the interpreter, while a daemon thread still waits in C++ code. Python before 3.14 ends such a thread
   by unwinding its stack. Then C++ prints "terminate called without an active exception" and raises SIGABRT.

The repair. Cases 1, 2 and 4 raise ExternalShutdownException or KeyboardInterrupt instead. Case 3 is ignored, because
the context is shut down as requested. In case 5 the waits are ended before the interpreter exits.
"""

from __future__ import annotations

import atexit
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from types import ModuleType
from typing import Any

from ros_runtime.workarounds.rclpy_repairs.version import numbers

FIRST_AFFECTED = (7, 1, 0)
# Jazzy has 7.1; later versions were not examined.
FIRST_UNKNOWN = (7, 2, 0)

_SHUTDOWN_TIMEOUT = 0.5  # s from SIGINT to the shutdown of the context, on a busy machine
_WAITS_END_TIMEOUT = 1.0  # s for threads to return from C++ when the interpreter exits


def needs_repair(version: str) -> bool:
    """Return whether this version of rclpy has the faults."""
    return FIRST_AFFECTED <= numbers(version) < FIRST_UNKNOWN


def repair(executors: ModuleType) -> None:
    """Change the classes Executor and Context of the module rclpy.executors in place."""
    executor, context = executors.Executor, executors.Context
    waits = _Waits()
    atexit.register(waits.end)
    executor.wait_for_ready_callbacks = _waiting(executor.wait_for_ready_callbacks, executors, waits)
    executor._make_handler = _handling(executor._make_handler)
    context.try_shutdown = _shutting_down(context.try_shutdown)
    for spinning in (executors.SingleThreadedExecutor, executors.MultiThreadedExecutor):
        spinning._spin_once_impl = _spinning(spinning._spin_once_impl, executors)


def _waiting(wait: Callable[..., Any], executors: ModuleType, waits: _Waits) -> Callable[..., Any]:
    expected = (
        executors.TimeoutException,
        executors.ShutdownException,
        executors.ExternalShutdownException,
        executors.ConditionReachedException,
    )

    def wait_for_ready_callbacks(self: Any, *args: Any, **kwargs: Any) -> Any:
        try:
            if not waits.begin(self):
                raise executors.ShutdownException
            return wait(self, *args, **kwargs)
        except expected:
            raise
        except Exception:
            if self._is_shutdown:
                raise executors.ShutdownException from None
            if not self._context.ok():
                raise executors.ExternalShutdownException from None
            raise
        finally:
            waits.finish()

    return wait_for_ready_callbacks


def _handling(make_handler: Callable[..., Any]) -> Callable[..., Any]:
    def make_interruptible_handler(
        self: Any, entity: Any, node: Any, take_from_wait_list: Callable[[Any], Any]
    ) -> Any:
        def take(entity: Any) -> Any:
            try:
                return take_from_wait_list(entity)
            except RuntimeError as error:
                if "Unable to convert call argument" in str(error) and _shuts_down_soon(self._context):
                    raise KeyboardInterrupt from None
                raise

        return make_handler(self, entity, node, take)

    return make_interruptible_handler


def _spinning(spin_once: Callable[..., None], executors: ModuleType) -> Callable[..., None]:
    def spin_once_until_shutdown(self: Any, *args: Any, **kwargs: Any) -> None:
        try:
            spin_once(self, *args, **kwargs)
        except RuntimeError as error:
            if "context is invalid" in str(error) and not self._context.ok():
                raise executors.ExternalShutdownException from error
            raise

    return spin_once_until_shutdown


def _shuts_down_soon(context: Any) -> bool:
    """Return whether the context is shut down now or within _SHUTDOWN_TIMEOUT."""
    end = time.monotonic() + _SHUTDOWN_TIMEOUT
    while context.ok():
        if time.monotonic() >= end:
            return False
        time.sleep(0.001)
    return True


def _shutting_down(try_shutdown: Callable[[Any], None]) -> Callable[[Any], None]:
    def try_shutdown_once(self: Any) -> None:
        try:
            try_shutdown(self)
        except RuntimeError:
            if self.ok():
                raise

    return try_shutdown_once


class _Waits:
    """The executors that wait for work, by the id of the thread in which each waits.

    This class uses no lock, because a KeyboardInterrupt could leave the lock locked.
    """

    def __init__(self) -> None:
        self._executors: dict[int, Any] = {}
        self._ended = False

    def begin(self, executor: Any) -> bool:
        """Register a waiting executor; return False if the interpreter is exiting."""
        self._executors[threading.get_ident()] = executor
        return not self._ended

    def finish(self) -> None:
        self._executors.pop(threading.get_ident(), None)

    def end(self) -> None:
        """Wake the waiting executors, and wait until their threads have returned from C++."""
        self._ended = True
        self.finish()
        for executor in list(self._executors.values()):
            executor._is_shutdown = True
            with suppress(RuntimeError):  # the executor has been destroyed meanwhile
                executor.wake()
        end = time.monotonic() + _WAITS_END_TIMEOUT
        while self._executors and time.monotonic() < end:
            time.sleep(0.001)
