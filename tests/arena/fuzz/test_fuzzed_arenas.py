"""Generated programs in arenas: each is graded, and none gets full marks, changes the next grade or leaves residue."""

from __future__ import annotations

import pytest

from autograder.isolation.availability import available_isolation
from fuzz.arena.generated_program import find_problem, program
from fuzz.arena.targets import TARGETS
from fuzz.readers.all import READERS


@pytest.mark.skipif(not available_isolation().trusted, reason="hidden checks need isolated arenas")
@pytest.mark.parametrize(("name", "seed"), [("arena-service", 1), ("arena-action", 1), ("arena-service", 2)])
def test_fuzzing_an_arena_finds_no_error(name: str, seed: int) -> None:
    assert find_problem(name, seed) == ""


def test_fuzzing_recorded_runs_finds_no_error() -> None:
    READERS["answers-judged"].run()


@pytest.mark.parametrize("name", TARGETS)
def test_a_seed_makes_one_program(name: str) -> None:
    source = program(TARGETS[name], 7)
    assert source == program(TARGETS[name], 7)
    assert source != program(TARGETS[name], 8)
    namespace: dict[str, object] = {"__name__": "generated"}
    exec(compile(source, "generated.py", "exec"), namespace)
    assert callable(namespace["wild_message"])
    assert namespace["OFFERS"] == TARGETS[name].offers
