"""Made-up programs in arenas: each is graded, none has full marks, none changes the next grade or leaves anything."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from autograder.isolation.availability import available_isolation
from fuzz.arena.made_up import look, program
from fuzz.arena.targets import TARGETS
from fuzz.readers.all import READERS


@pytest.mark.skipif(not available_isolation().trusted, reason="hidden checks need isolated arenas")
@pytest.mark.parametrize(("name", "seed"), [("arena-service", 1), ("arena-action", 1), ("arena-service", 2)])
def test_nothing_is_found_in_an_arena(name: str, seed: int) -> None:
    finding = look(name, seed)
    assert finding is None, finding


def test_nothing_is_found_in_recorded_runs_with_other_messages() -> None:
    finding = READERS["answers-judged"].look(1, 60)
    assert finding is None, finding


@pytest.mark.parametrize("name", TARGETS)
def test_a_seed_makes_one_program(name: str) -> None:
    source = program(TARGETS[name], 7)
    assert source == program(TARGETS[name], 7)
    assert source != program(TARGETS[name], 8)
    namespace: dict[str, object] = {"__name__": "made_up"}
    exec(compile(source, "made_up.py", "exec"), namespace)
    assert callable(namespace["wild_message"])
    assert namespace["OFFERS"] == TARGETS[name].offers


def test_the_command_runs_one_seed_of_the_fuzzers_that_are_named() -> None:
    course = [str(Path(sys.executable).with_name("course")), "test", "--fuzz", "0", "--fuzz-seed", "5"]
    only = ["--fuzz-only", "output-kept", "--fuzz-only", "graph"]
    ran = subprocess.run([*course, *only], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "2 fuzzers for 0 minutes from seed 5 on" in ran.stdout
    assert "1 seeds, 0 findings" in ran.stdout
