"""A student's program that never ends, or is gone before anybody saw it, holds nothing up."""

from __future__ import annotations

import threading
from typing import Any

import pytest

pytest.importorskip("rclpy")

from autograder.arena import client_stage as client_stage_module
from autograder.arena.client_stage import ClientStage
from autograder.arena.phases import Phases


class FakeNode:
    """A node in a graph of which every question fails."""

    def __getattr__(self, question: str) -> Any:
        def fail(*_: Any) -> None:
            raise UnicodeDecodeError("utf-8", b"\xff", 0, 1, "invalid start byte")

        return fail


class FakeStudent:
    """A program that is started, and has ended or has not."""

    def __init__(self, has_exited: bool) -> None:
        self._has_exited = has_exited

    def start(self, *_: Any) -> None:
        pass

    start_module = start

    def has_exited(self) -> bool:
        return self._has_exited


class Kept:
    """Stands for a recorder."""

    def __init__(self) -> None:
        self.events: list[dict[str, Any]] = []

    def record(self, kind: str, **fields: Any) -> None:
        self.events.append({"kind": kind, **fields})


def stage_of(*, has_exited: bool) -> tuple[ClientStage, Kept]:
    kept: Any = Kept()
    node: Any = FakeNode()
    student: Any = FakeStudent(has_exited)
    phases = Phases(kept, wanted=False)
    return ClientStage(node, kept, threading.Condition(), student, phases, lambda: None), kept


def test_a_module_that_never_ends_is_recorded_and_the_scenario_goes_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(client_stage_module, "MODULE_TIMEOUT", 0.01)
    stage, kept = stage_of(has_exited=False)
    stage.run_module("any", [], [])
    (event,) = kept.events
    assert (event["kind"], event["what"], event["id"]) == ("unanswered", "end", "program")


def test_a_graph_that_cannot_be_read_is_no_node_and_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(client_stage_module, "APPEARING_TIMEOUT", 0.01)
    stage, kept = stage_of(has_exited=False)
    stage.start_program()
    assert [event["kind"] for event in kept.events] == ["graph_flooded"]


def test_a_program_that_has_ended_is_not_waited_for() -> None:
    stage, kept = stage_of(has_exited=True)
    stage.start_program()
    stage.wait_for_end()
    assert "unanswered" not in [event["kind"] for event in kept.events]
