"""A spin loop that survives rclpy's exceptions: an unreadable message must not stop the recording."""

from __future__ import annotations

import traceback

from rclpy.executors import Executor, ExternalShutdownException

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog

RCLPY_ERRORS = (RuntimeError, UnicodeError, MemoryError)  # what rclpy can raise for an unreadable message


def keep_spinning(executor: Executor, log: ArenaLog) -> None:
    """Spin until the context is shut down; count unreadable messages; an error of the grader fails the scenario."""
    while executor.context.ok():
        try:
            executor.spin_once()
        except ExternalShutdownException:
            return
        except RCLPY_ERRORS:
            traceback.print_exc()
            log.drop("unreadable")
        except Exception as error:
            traceback.print_exc()
            log.append(ev.ScenarioFailed(reason=f"{type(error).__name__}: {error}"))
            return
