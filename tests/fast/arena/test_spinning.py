"""The agent's executor keeps spinning, whatever exception rclpy raises for a message."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip("rclpy")

from autograder.arena import events as ev
from autograder.arena.agent import keep_spinning
from autograder.arena.arena_log import ArenaLog


class Executor:
    """Raises the given errors in turn; then its context is shut down."""

    def __init__(self, *errors: Exception | None) -> None:
        self._errors = list(errors)
        self.rounds = 0
        self.context = SimpleNamespace(ok=lambda: bool(self._errors))

    def spin_once(self) -> None:
        self.rounds += 1
        error = self._errors.pop(0)
        if error:
            raise error


def spin(log: ArenaLog, *errors: Exception | None) -> Executor:
    executor = Executor(*errors)
    keep_spinning(executor, log)  # type: ignore[arg-type]
    log.finish()
    return executor


def test_messages_that_cannot_be_read_are_counted_and_the_next_one_is_taken(log: ArenaLog) -> None:
    executor = spin(log, RuntimeError("failed to deserialize"), None, MemoryError(), None)
    assert executor.rounds == 4
    assert [(event.what, event.count) for event in log.all(ev.RecordDropped)] == [("unreadable", 2)]


def test_an_error_of_the_grader_invalidates_the_run(log: ArenaLog) -> None:
    executor = spin(log, AttributeError("no field"), None)
    assert executor.rounds == 1
    assert [event.reason for event in log.all(ev.ScenarioFailed)] == ["AttributeError: no field"]
