"""A student's program that never ends, or ends before it is discovered, delays nothing."""

from __future__ import annotations

from typing import Any

import pytest

pytest.importorskip("rclpy")

from autograder.arena import client_stage as client_stage_module
from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.client_stage import ClientStage
from autograder.arena.phases import Phases


class FakeNode:
    """A node for which every query of the graph fails."""

    def __getattr__(self, question: str) -> Any:
        def fail(*_: Any) -> None:
            raise UnicodeDecodeError("utf-8", b"\xff", 0, 1, "invalid start byte")

        return fail


class FakeStudent:
    """A program that was started; it runs or has ended."""

    def __init__(self, has_exited: bool) -> None:
        self._has_exited = has_exited

    def start(self, *_: Any) -> None:
        pass

    start_module = start

    def has_exited(self) -> bool:
        return self._has_exited


def stage_of(log: ArenaLog, *, has_exited: bool) -> ClientStage:
    node: Any = FakeNode()
    student: Any = FakeStudent(has_exited)
    return ClientStage(node, log, student, Phases(log, wanted=False), lambda: None)


def test_a_module_that_never_ends_is_recorded_and_the_scenario_continues(
    log: ArenaLog, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(client_stage_module, "MODULE_TIMEOUT", 0.01)
    stage = stage_of(log, has_exited=False)
    stage.run_module("any", [], [])
    (event,) = log.all(ev.Unanswered)
    assert (event.what, event.id) == ("end", "program")


def test_an_unreadable_graph_has_no_node_and_is_recorded(
    log: ArenaLog, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(client_stage_module, "APPEARING_TIMEOUT", 0.01)
    stage = stage_of(log, has_exited=False)
    stage.start_program()
    assert log.count(ev.GraphFlooded) == 1
    assert log.count(ev.NodeReady) == 0


def test_a_program_that_has_ended_is_not_waited_for(log: ArenaLog) -> None:
    stage = stage_of(log, has_exited=True)
    stage.start_program()
    stage.wait_for_end()
    assert log.all(ev.Unanswered) == []
