"""Repair of rclpy's ActionClient, which may lose the response to a goal, a cancel request or a result request.

What happens. If one thread sends and another one spins, a quick response is dropped with the warning "Ignoring
unexpected goal response", and the future of the request never completes (ros2/rclpy#1123).

Why. The client sends the request first and stores its sequence number afterwards. If the spinning thread takes the
response in between, it finds no request with that number.

The repair. A lock makes sending and storing one step, during which no response is taken. (Upstream's fix, in #1308 and
its backports, holds a lock over the same lines.)
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import wraps
from types import ModuleType
from typing import Any

_SENDING = ("send_goal_async", "_cancel_goal_async", "_get_result_async")


def needs_repair(module: ModuleType) -> bool:
    """Return whether the ActionClient of rclpy.action.client has the fault; upstream's fix uses a lock."""
    return "_lock" not in module.ActionClient.send_goal_async.__code__.co_names


def repair(module: ModuleType) -> None:
    """Change the class ActionClient of the module rclpy.action.client in place."""
    cls = module.ActionClient
    initialise = cls.__init__

    @wraps(initialise)
    def initialise_with_lock(self: Any, *args: Any, **kwargs: Any) -> None:
        self._one_step = threading.RLock()
        initialise(self, *args, **kwargs)

    cls.__init__ = initialise_with_lock
    for name in (*_SENDING, "take_data"):
        setattr(cls, name, _in_one_step(getattr(cls, name)))


def _in_one_step(method: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(method)
    def locked(self: Any, *args: Any, **kwargs: Any) -> Any:
        with self._one_step:
            return method(self, *args, **kwargs)

    return locked
