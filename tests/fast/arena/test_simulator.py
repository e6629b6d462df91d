"""What a scenario asks of the simulator stands in the transcript, whether it takes effect or not."""

from __future__ import annotations

import json
import os
import threading
import time
from collections.abc import Sequence
from typing import Any

from autograder.arena.simulator import Simulator


class Kept:
    """Stands for a recorder."""

    def __init__(self) -> None:
        self.events: list[dict[str, Any]] = []

    def record(self, kind: str, **fields: Any) -> None:
        self.events.append({"kind": kind, **fields})

    def forward(self, line: bytes) -> None:
        self.events.append(json.loads(line))


class Obedient:
    """Stands for the robots: says of the first command that it has taken effect, and goes on for a while."""

    def serve(self, options: Sequence[str], *more: str) -> None:
        given = dict(zip(more[::2], more[1::2], strict=True))
        command = json.loads(os.read(int(given["--control-fd"]), 1000))
        taken = {"kind": "command", "command": command}
        os.write(int(given["--ground-truth-fd"]), json.dumps(taken).encode() + b"\nno end of a line")
        time.sleep(60)


def test_a_command_is_recorded_as_sent_and_waits_to_be_obeyed() -> None:
    kept, changed = Kept(), threading.Condition()
    simulator = Simulator(kept, changed, Obedient(), "/robot", ())  # type: ignore[arg-type]
    simulator.command("set_battery", percentage=0.35)
    assert not simulator.has_obeyed()
    simulator.listen()
    with changed:
        assert changed.wait_for(simulator.has_obeyed, 20)
    simulator.stop()
    command = {"do": "set_battery", "percentage": 0.35}
    assert kept.events == [
        {"kind": "command_sent", "command": command},
        {"kind": "command", "command": command},
    ]
    assert not simulator.is_running()
