"""What a scenario asks of the simulator stands in the transcript, whether it takes effect or not."""

from __future__ import annotations

import json
import os
import threading
from typing import Any

import pytest

from autograder.arena import simulator as simulator_module
from autograder.arena.simulator import Simulator


class Kept:
    """Stands for a recorder."""

    def __init__(self) -> None:
        self.events: list[dict[str, Any]] = []

    def record(self, kind: str, **fields: Any) -> None:
        self.events.append({"kind": kind, **fields})

    def forward(self, line: bytes) -> None:
        pass


def test_a_command_is_recorded_as_sent_and_waits_to_be_obeyed(monkeypatch: pytest.MonkeyPatch) -> None:
    received: list[int] = []

    def start(*_: Any, pass_fds: tuple[int, int], **__: Any) -> None:
        received.append(os.dup(pass_fds[1]))

    monkeypatch.setattr(simulator_module.subprocess, "Popen", start)
    kept = Kept()
    simulator = Simulator(kept, threading.Condition(), "/robot", (), {})  # type: ignore[arg-type]
    simulator.command("set_battery", percentage=0.35)
    command = {"do": "set_battery", "percentage": 0.35}
    assert kept.events == [{"kind": "command_sent", "command": command}]
    assert json.loads(os.read(received[0], 1000)) == command
    assert not simulator.has_obeyed()
    os.close(received[0])
