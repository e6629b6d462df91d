"""Grades many submissions in parallel; a failure of one does not stop the others."""

from __future__ import annotations

import os
from collections.abc import Generator, Iterable, Iterator, Mapping, Sized
from dataclasses import dataclass, field
from functools import lru_cache, partial
from pathlib import Path

from autograder.classroom.batch.cache import CachedGrade, GradeCache
from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.grades_without_run import unreadable
from autograder.classroom.batch.job import (
    BatchWatcher,
    Effort,
    GradingJob,
    SharedState,
    carry_out,
    without_arena,
)
from autograder.classroom.batch.seeds import ONE_FOR_ALL, Seeds
from autograder.classroom.batch.version import checks_version
from autograder.classroom.batch.worker_pool import WorkerPool, Workers, threads
from autograder.classroom.pages.drawings import Drawings
from autograder.engine.essay import load_essay, unmarked_grade
from autograder.engine.exercise import FOLDER_VARIABLE, Exercise, essay_names, load_exercise
from autograder.engine.stop import Stop
from autograder.engine.submission import UnusableSubmission
from autograder.engine.verdict import Grade
from autograder.isolation.availability import Isolation
from autograder.recording.kept import keep

RESULT_POLL_TIME = 0.5  # s to wait for results before the next poll for new submissions


@dataclass(frozen=True)
class Graded:
    """A submission with its grade. If it could not be read, `sources` is None and `problem` says why.

    `effort` is that of the run that produced the grade; None if a worker was lost.
    """

    work: Work
    grade: Grade
    sources: Mapping[str, str] | None
    problem: str = ""
    cached: bool = False
    effort: Effort | None = None


@dataclass
class BatchRunner:
    """Grades submissions; without trusted isolation only with the visible checks.

    Attributes:
        cache: stores every grade as soon as it is known.
        isolation: the isolation of the workers.
        jobs: number of arenas that run in parallel on this machine.
        seeds: draw the inputs of the scenarios.
        resume: reuse grades from the cache.
        watcher: the callbacks of the batch.
        drawings: stores the drawings of failed checks.
        recordings: folder for recordings, in <student>/<exercise>/; None: do not record.
        workers: where jobs run; None: in `jobs` threads of this process.
    """

    cache: GradeCache
    isolation: Isolation
    jobs: int
    seeds: Seeds = ONE_FOR_ALL
    resume: bool = False
    watcher: BatchWatcher = field(default_factory=BatchWatcher)
    drawings: Drawings | None = None
    recordings: Path | None = None
    workers: Workers | None = None

    def __post_init__(self) -> None:
        self._stop = Stop()
        # returns an exercise by its name, with the checks of this batch
        self.exercise = lru_cache(self._load)

    def count(self, name: str) -> int:
        """Return the number of verdicts that this batch gives on one submission for an exercise."""
        return len(load_essay(name).criteria if name in essay_names() else self.exercise(name).checks)

    def run(self, works: Iterable[Work | None]) -> Generator[Graded, None, None]:
        """Yield each submission once, as soon as it is graded.

        `works` may be endless: it yields None while there is no new submission, so that finished results can be
        collected. It may yield a submission again after that submission's result.

        Leaving the loop early, for example by Ctrl-C, ends the running arenas at once; finished grades stay in the
        cache.
        """
        submissions = len(works) if isinstance(works, Sized) else self.jobs
        arenas = 1 if self.workers else max(1, self.jobs // max(1, submissions))
        workers = self.workers or threads(max(1, self.jobs // arenas))
        state = SharedState(self.isolation, self._stop, self.watcher)
        shared = state if workers.share_memory else None
        pool = WorkerPool(workers, partial(carry_out, shared=shared), self.watcher.on_retry)
        handed_over: dict[tuple[str, str], Work] = {}
        try:
            for work in works:
                if work is None:
                    if pool.is_busy:
                        yield from self._finish(pool, handed_over, RESULT_POLL_TIME)
                    continue
                prepared = self._prepare(work, arenas)
                if isinstance(prepared, Graded):
                    for verdict in prepared.grade.checks:
                        self.watcher.on_verdict(verdict)
                    yield prepared
                    continue
                while not pool.has_room:
                    yield from self._finish(pool, handed_over)
                handed_over[work.student, work.exercise] = work
                pool.submit(prepared)
            while pool.is_busy:
                yield from self._finish(pool, handed_over)
        finally:
            self._stop.set()
            pool.close()

    def _load(self, name: str) -> Exercise:
        return load_exercise(name, hidden=self.isolation.trusted)

    def _prepare(self, work: Work, arenas: int) -> Graded | GradingJob:
        """Return the grade of a submission that needs no arena (essay, unreadable, cached), else its job."""
        try:
            submission, problem = work.read(), ""
        except UnusableSubmission as error:
            submission, problem = None, str(error)
        sources = submission.sources if submission else None
        if work.exercise in essay_names():  # a person marks every essay, even an unreadable one
            waiting = unmarked_grade(load_essay(work.exercise), work.student)
            return Graded(work, waiting, sources, problem, effort=without_arena())
        exercise, seed = self.exercise(work.exercise), self.seeds.of(work.student, sources or {})
        if submission is None:
            grade = unreadable(work.student, exercise, self.isolation.label, seed, problem)
            return Graded(work, grade, None, problem, effort=without_arena())
        if self.resume and (known := self.cache.get(submission, exercise, seed)):
            return Graded(work, known.grade, sources, cached=True, effort=known.effort)
        return GradingJob(
            work.student,
            work.exercise,
            dict(submission.sources),
            seed,
            self.isolation.trusted,
            checks_version(exercise.folder),
            arenas,
            os.environ.get(FOLDER_VARIABLE),
            self.recordings is not None,
        )

    def _finish(
        self, pool: WorkerPool, handed_over: dict[tuple[str, str], Work], timeout: float | None = None
    ) -> Iterator[Graded]:
        """Wait for outcomes, and cache all of them before yielding the first, so that Ctrl-C loses none."""
        finished = []
        for job, outcome in pool.wait(timeout):
            work = handed_over.pop((job.student, job.exercise))
            if outcome.effort:
                known = CachedGrade(outcome.grade, outcome.effort)
                self.cache.put(job.submission, self.exercise(job.exercise), job.seed, known)
            if self.drawings:
                self.drawings.keep_all(outcome.grade, job.sources, outcome.drawn)
            if self.recordings:
                keep(self.recordings / job.student / job.exercise, outcome.recordings)
            finished.append(Graded(work, outcome.grade, job.sources, effort=outcome.effort))
            if self.workers and not self.workers.share_memory:
                for verdict in outcome.grade.checks:
                    self.watcher.on_verdict(verdict)
        yield from finished
