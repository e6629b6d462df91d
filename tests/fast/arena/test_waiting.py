"""The end of a scenario: earlier messages are still received, and an endless flood is recorded."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, repeat
from typing import Any

import pytest

pytest.importorskip("rclpy")

from autograder.arena import offering as offering_module
from autograder.arena.offering import FLOOD_TIMEOUT, QUIET_TIME, Offering


class Kept:
    """A test double of a log and a graph, with the number of messages that the log has received at each poll."""

    def __init__(self, received: Iterator[int]) -> None:
        self._received = received
        self.steps: list[str] = []

    @property
    def received(self) -> int:
        self.steps.append("look")
        return next(self._received)

    def drop(self, kind: str) -> None:
        self.steps.append(f"drop {kind}")

    def inspect(self) -> None:
        self.steps.append("inspect")

    def finish(self) -> None:
        self.steps.append("finish")


def stage_of(kept: Any) -> Offering:
    stage = Offering(kept, kept, kept, kept, lambda: None)
    stage._graph = kept
    return stage


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """A clock that advances only during `sleep`."""
    now = [0.0]

    def sleep(duration: float) -> None:
        now[0] += duration

    monkeypatch.setattr(offering_module.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(offering_module.time, "sleep", sleep)


def close(received: Iterator[int]) -> list[str]:
    kept = Kept(received)
    stage_of(kept).close()
    return kept.steps


@pytest.mark.usefixtures("clock")
def test_after_a_correct_node_one_check_is_enough() -> None:
    assert close(iter([400, 402])) == ["look", "look", "inspect", "finish"]


@pytest.mark.usefixtures("clock")
def test_the_end_of_a_flood_is_waited_for() -> None:
    assert close(iter([0, 500, 1000, 1010])) == ["look"] * 4 + ["inspect", "finish"]


@pytest.mark.usefixtures("clock")
def test_a_flood_without_end_is_recorded() -> None:
    steps = close(chain(range(0, 10**6, 500), repeat(0)))
    assert steps[-3:] == ["drop unread", "inspect", "finish"]
    assert len(steps) < FLOOD_TIMEOUT / QUIET_TIME + 6


@pytest.mark.usefixtures("clock")
def test_a_condition_without_a_notification_is_polled_until_the_timeout() -> None:
    stage = stage_of(Kept(iter([])))
    looks = iter([False, False, True])
    assert stage.poll_until(lambda: next(looks), 1.0)
    assert not stage.poll_until(lambda: False, 1.0)
