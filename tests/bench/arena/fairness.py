"""Measures whether a correct server gets the same verdicts and feedback rate every time, at any scale of the clock."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import pairwise

from autograder.authoring.checks import Scenario
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.arena_run import ArenaRun, NotGraded, run_in_arena
from autograder.engine.exercise import Exercise
from autograder.engine.simulation_lag import lateness
from autograder.engine.submission import Submission
from autograder.engine.submission_arenas import SubmissionArenas

FAIR_RATE = (4.0, 6.0)  # Hz, of feedback that is meant at 5 Hz


@dataclass(frozen=True)
class FairRun:
    """One walk: feedback rate (Hz), largest gap (s), how late the simulator was (s), and what failed."""

    scale: float
    rate: float
    gap: float
    lag: float
    failed: tuple[str, ...]

    @property
    def fair(self) -> bool:
        """Whether feedback kept its rate and every check of the scenario passed."""
        return FAIR_RATE[0] <= self.rate <= FAIR_RATE[1] and not self.failed


def fairness_runs(
    submission: Submission,
    exercise: Exercise,
    scenario: Scenario,
    *,
    runs: int,
    scale: float,
    jobs: int,
    progress: Callable[[FairRun], None] = lambda run: None,
) -> list[FairRun]:
    """Run the scenario `runs` times at one scale; judge each run by the checks that need no other scenario."""

    def one(_index: int) -> FairRun:
        walk = ArenaRun(exercise, submission.files, scenario, 0, scale)
        try:
            run = _judged(run_in_arena(walk, arenas=arenas), exercise, scenario)
        except NotGraded as error:
            run = FairRun(scale, 0.0, 0.0, 0.0, (str(error).splitlines()[0],))
        progress(run)
        return run

    with SubmissionArenas(exercise.scenario_file) as arenas, ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(one, range(runs)))


def _judged(transcript: Transcript, exercise: Exercise, scenario: Scenario) -> FairRun:
    failed = []
    for check in exercise.checks:
        if check.on != (scenario,):
            continue
        try:
            check.run([transcript])
        except (Failure, LookupError) as failure:
            failed.append(f"{check.id}: {failure}")
    times = [feedback.t for feedback in transcript.goals[0].feedback]
    gaps = [later - earlier for earlier, later in pairwise(times)]
    rate = len(gaps) / sum(gaps) if gaps else 0.0
    return FairRun(transcript.scale, rate, max(gaps, default=0.0), lateness(transcript), tuple(failed))
