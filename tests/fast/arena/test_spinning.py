"""The agent's executor goes on, whatever a message makes rclpy raise."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

pytest.importorskip("rclpy")

from autograder.arena.spinning import keep_spinning


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


class Kept:
    """Stands for a recorder."""

    def __init__(self) -> None:
        self.dropped: list[str] = []
        self.recorded: list[str] = []

    def drop(self, kind: str) -> None:
        self.dropped.append(kind)

    def record(self, kind: str, **fields: Any) -> None:
        self.recorded.append(f"{kind}: {fields['reason']}")


def spin(*errors: Exception | None) -> tuple[Executor, Kept]:
    executor, kept = Executor(*errors), Kept()
    keep_spinning(executor, kept)  # type: ignore[arg-type]
    return executor, kept


def test_messages_that_cannot_be_read_are_counted_and_the_next_one_is_taken() -> None:
    executor, kept = spin(RuntimeError("failed to deserialize"), None, MemoryError(), None)
    assert executor.rounds == 4
    assert kept.dropped == ["unreadable", "unreadable"]


def test_an_error_of_ours_makes_the_run_void() -> None:
    executor, kept = spin(AttributeError("no field"), None)
    assert executor.rounds == 1
    assert kept.recorded == ["scenario_failed: AttributeError: no field"]
