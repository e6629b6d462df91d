"""Grades many submissions in parallel; a failure of one does not stop the others."""

from __future__ import annotations

import dataclasses
import threading
import traceback
from collections.abc import Callable, Generator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from dataclasses import dataclass

from autograder.batch.cache import GradeCache
from autograder.batch.collection import Work
from autograder.engine.essay import left_to_a_person, load_essay
from autograder.engine.exercise import Exercise, essay_names, load_exercise
from autograder.engine.grading import Evidence, Report, grade
from autograder.engine.submission import Submission, UnusableSubmission
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.isolation.availability import Isolation

EvidenceOf = Callable[[str, Mapping[str, str]], Evidence]


@dataclass(frozen=True)
class Graded:
    """A submission with its grade. If it could not be read, `sources` is None and `problem` says why."""

    work: Work
    grade: Grade
    sources: Mapping[str, str] | None
    problem: str = ""
    cached: bool = False


class _Interrupted(Exception):
    """The batch was stopped while this submission was being graded."""


class BatchRunner:
    """Grades submissions in `jobs` arenas in parallel; without trusted isolation only with the visible checks.

    `report` is called with each verdict as soon as it is known, on any thread, and what `evidence` returns for an
    exercise and its sources with each verdict and the transcripts it was judged on.
    """

    def __init__(
        self,
        cache: GradeCache,
        isolation: Isolation,
        *,
        jobs: int,
        seed: int = 0,
        resume: bool = False,
        report: Report = lambda verdict: None,
        evidence: EvidenceOf = lambda exercise, sources: lambda verdict, transcripts: None,
    ) -> None:
        self._cache = cache
        self._isolation = isolation
        self._jobs = jobs
        self._seed = seed
        self._resume = resume
        self._report = report
        self._evidence = evidence
        self._stop = threading.Event()

    def exercise(self, name: str) -> Exercise:
        """Return an exercise with the checks that this batch makes."""
        return load_exercise(name, hidden=self._isolation.trusted)

    def count(self, name: str) -> int:
        """Return how many verdicts this batch gives on a submission for an exercise."""
        return len(load_essay(name).criteria if name in essay_names() else self.exercise(name).checks)

    def run(self, works: Sequence[Work]) -> Generator[Graded, None, None]:
        """Yield each submission as soon as it is graded.

        Leaving the loop early, for example by Ctrl-C, ends the running arenas; finished grades stay in the cache.
        """
        jobs_each = max(1, self._jobs // max(1, len(works)))
        with ThreadPoolExecutor(max_workers=max(1, self._jobs // jobs_each)) as pool:
            futures: list[Future[Graded]] = [pool.submit(self._grade, work, jobs_each) for work in works]
            try:
                for future in as_completed(futures):
                    yield future.result()
            finally:
                self._stop.set()
                pool.shutdown(wait=True, cancel_futures=True)

    def _grade(self, work: Work, jobs: int) -> Graded:
        if work.exercise in essay_names():
            return self._leave_to_a_person(work)
        exercise = self.exercise(work.exercise)
        try:
            submission = work.read()
        except UnusableSubmission as problem:
            unread = unreadable(work, exercise, self._isolation, str(problem))
            for verdict in unread.checks:
                self._report(verdict)
            return Graded(work, unread, None, str(problem))
        if self._resume and (known := self._cache.get(submission, exercise)):
            for verdict in known.checks:
                self._report(verdict)
            return Graded(work, known, submission.sources, cached=True)
        result = self._grade_in_arenas(submission, exercise, jobs)
        self._cache.put(submission, exercise, result)
        return Graded(work, result, submission.sources)

    def _leave_to_a_person(self, work: Work) -> Graded:
        """Read an essay; also of one that cannot be read a person decides what it is worth."""
        waiting = left_to_a_person(load_essay(work.exercise), work.student)
        for verdict in waiting.checks:
            self._report(verdict)
        try:
            return Graded(work, waiting, work.read().sources)
        except UnusableSubmission as problem:
            return Graded(work, waiting, None, str(problem))

    def _grade_in_arenas(self, submission: Submission, exercise: Exercise, jobs: int) -> Grade:
        try:
            return with_reason(
                grade(
                    submission,
                    exercise,
                    seed=self._seed,
                    jobs=jobs,
                    isolation=self._isolation,
                    report=self._report_or_stop,
                    evidence=self._evidence(exercise.name, submission.sources),
                )
            )
        except _Interrupted:
            raise
        except Exception:  # whatever goes wrong here is the grader's fault and may not end the batch
            return Grade(
                exercise.name,
                submission.student,
                self._isolation.label,
                reason=f"the grader itself failed:\n{traceback.format_exc()}",
            )

    def _report_or_stop(self, verdict: CheckVerdict) -> None:
        """Once the batch was stopped, raise at the next verdict of a submission; `grade` then ends its arenas."""
        if self._stop.is_set():
            raise _Interrupted
        self._report(verdict)


def unreadable(work: Work, exercise: Exercise, isolation: Isolation, problem: str) -> Grade:
    """Return the grade of an unreadable submission: no points, and the reason at its first check."""
    first, *others = exercise.checks
    names = " and ".join(exercise.file_names)
    verdicts = [
        CheckVerdict(
            first.id,
            first.title,
            "failed",
            0,
            first.points,
            expected=f"{names}, or a notebook with cells that begin '%%writefile {exercise.file_names[0]}'",
            observed=problem,
            help="Open the file you handed in, put this right and hand it in again.",
        ),
        *(
            CheckVerdict(
                check.id,
                check.title,
                "not run",
                0,
                check.points,
                help="The submission could not be read.",
                hidden=check.hidden,
            )
            for check in others
        ),
    ]
    return Grade(exercise.name, work.student, isolation.label, verdicts)


def with_reason(grade: Grade) -> Grade:
    """Return the grade with the first cause of a check that could not be judged as its reason."""
    if grade.status == "graded" or grade.reason:
        return grade
    broken = next((verdict for verdict in grade.checks if verdict.status == "error"), None)
    return dataclasses.replace(
        grade, reason=f"{broken.id}: {broken.help}" if broken else "no check was judged"
    )
