"""Runs a waiting coroutine of a student's node, and prints how often the node's timers fired before and after its end.

timed_waits.py awaiting Awaiting wait
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Future
from rclpy.utilities import remove_ros_args

WAIT = 0.3  # s that the coroutine is asked to wait
MAX_WAIT = 5.0  # s, on a busy machine
TIME_AFTER_THE_END = 1.0  # s; a timer that was not destroyed fires three times in it


def main() -> None:
    """Run the coroutine to its end on one thread, then keep spinning."""
    sys.path.insert(0, os.getcwd())
    rclpy.init()
    module, class_name, coroutine = remove_ros_args()[1:]
    node = getattr(import_module(module), class_name)()
    calls = 0
    create_timer = node.create_timer

    def counted(period: float, callback: Callable[[], Any], *arguments: Any, **options: Any) -> Any:
        def call() -> None:
            nonlocal calls
            calls += 1
            callback()

        return create_timer(period, call, *arguments, **options)

    node.create_timer = counted
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    task = executor.create_task(getattr(node, coroutine), WAIT)
    executor.spin_until_future_complete(task, timeout_sec=MAX_WAIT)
    until_the_end = calls
    executor.spin_until_future_complete(Future(), timeout_sec=TIME_AFTER_THE_END)
    print(json.dumps({"until_the_end": until_the_end, "after": calls - until_the_end}), flush=True)
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
