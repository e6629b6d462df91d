"""Measures what each check of an exercise costs: the arenas it needs, and how long they take."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from autograder.authoring.checks import Check, Scenario
from autograder.engine.arena_run import ArenaRun, run_in_arena
from autograder.engine.exercise import Exercise
from autograder.engine.submission import Submission


@dataclass(frozen=True)
class ArenaCost:
    """One scenario's arena: its duration in real time (wall s) and on its clock (arena s)."""

    wall: float
    clock: float


@dataclass(frozen=True)
class CheckCost:
    """The arenas of one check; an arena that several checks judge runs once and is counted for each."""

    check: Check
    arenas: tuple[ArenaCost, ...]


@dataclass(frozen=True)
class ExerciseCost:
    """The costs of every check; `arenas` has each scenario once."""

    checks: tuple[CheckCost, ...]
    arenas: tuple[ArenaCost, ...]


def total(arenas: Sequence[ArenaCost]) -> ArenaCost:
    """Return what arenas cost that run one after another."""
    return ArenaCost(sum(arena.wall for arena in arenas), sum(arena.clock for arena in arenas))


def cost_of_checks(
    submission: Submission,
    exercise: Exercise,
    *,
    scale: float,
    jobs: int,
    progress: Callable[[Scenario], None] = lambda scenario: None,
) -> ExerciseCost:
    """Run every scenario of the exercise once, `jobs` at a time.

    Raises:
        NotGraded: an arena failed.
    """
    scenarios = list(dict.fromkeys(scenario for check in exercise.checks for scenario in check.on))

    def one(scenario: Scenario) -> ArenaCost:
        started = time.monotonic()
        transcript = run_in_arena(ArenaRun(exercise, submission.files, scenario, scale=scale))
        cost = ArenaCost(time.monotonic() - started, transcript.end)
        progress(scenario)
        return cost

    with ThreadPoolExecutor(jobs) as pool:
        arenas = dict(zip(scenarios, pool.map(one, scenarios), strict=True))
    checks = (CheckCost(check, tuple(arenas[scenario] for scenario in check.on)) for check in exercise.checks)
    return ExerciseCost(tuple(checks), tuple(arenas.values()))
