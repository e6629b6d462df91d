"""The arena imports an exercise's scenarios from one file, whatever Python code the file contains."""

from __future__ import annotations

from pathlib import Path

from autograder.arena.agent import scenarios_in

DATACLASS = """
from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Way:
    x: float


def walk(stage):
    return Way(1.0)
"""


def test_scenarios_may_hold_a_dataclass(tmp_path: Path) -> None:
    file = tmp_path / "scenarios.py"
    file.write_text(DATACLASS)
    assert scenarios_in(str(file)).walk(None).x == 1.0
