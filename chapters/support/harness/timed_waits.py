"""Runs a waiting coroutine of a student's node, and prints how often its timers fired, and how many of them are left.

timed_waits.py awaiting Awaiting wait
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from typing import Any

import rclpy
from rclpy.exceptions import InvalidHandle
from rclpy.executors import SingleThreadedExecutor
from rclpy.utilities import remove_ros_args

WAIT = 0.3  # s that the coroutine is asked to wait
MAX_WAIT = 5.0  # s, on a busy machine


def timers(node: Any) -> int:
    """Return how many timers the node has, without those that were destroyed."""
    count = 0
    for timer in node.timers:
        with suppress(InvalidHandle), timer.handle:
            count += 1
    return count


def main() -> None:
    """Run the coroutine to its end on one thread."""
    sys.path.insert(0, os.getcwd())
    rclpy.init()
    module, class_name, coroutine = remove_ros_args()[1:]
    node = getattr(import_module(module), class_name)()
    fired, before = 0, timers(node)
    create_timer = node.create_timer

    def counted(period: float, callback: Callable[[], Any], *arguments: Any, **options: Any) -> Any:
        def call() -> None:
            nonlocal fired
            fired += 1
            callback()

        return create_timer(period, call, *arguments, **options)

    node.create_timer = counted
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    task = executor.create_task(getattr(node, coroutine), WAIT)
    executor.spin_until_future_complete(task, timeout_sec=MAX_WAIT)
    print(json.dumps({"fired": fired, "left": timers(node) - before}), flush=True)
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
