"""Grades known submissions with every check and compares the verdicts with the expected ones."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from autograder.classroom.audit.known_submission import KnownSubmission, require_known_checks
from autograder.engine.exercise import Exercise
from autograder.engine.grading import GradingOptions, grade
from autograder.engine.stop import Stop
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.engine.verdict import CheckStatus, Grade

if TYPE_CHECKING:
    from autograder.classroom.audit.audit_record import AuditRecord


@dataclass(frozen=True)
class AuditedRun:
    """One grading of a known submission; `seconds` is its wall time.

    `for_any_fault` has the ids of checks that any faulty submission may fail, because they judge random sequences.
    """

    known: KnownSubmission
    repetition: int
    grade: Grade
    seconds: float
    for_any_fault: Collection[str] = ()

    def status(self, check_id: str) -> CheckStatus:
        """Return the verdict of one check."""
        return next(check.status for check in self.grade.checks if check.id == check_id)

    def failed(self) -> list[str]:
        """Return the ids of the checks that failed."""
        return [check.id for check in self.grade.checks if check.status == "failed"]

    def missed(self) -> list[str]:
        """Return the checks that had to fail and did not.

        A hostile submission may first fail a check of its "Also fails", so that a check of "Caught by" is not run. That
        counts as caught, because the machine's speed decides when a flood of data takes effect.
        """
        failed = ["failed"]
        if self.known.kind == "hostile" and set(self.failed()) & set(self.known.also_fails):
            failed.append("not run")
        return [check_id for check_id in self.known.caught_by if self.status(check_id) not in failed]

    def unexpected(self) -> list[str]:
        """Return the checks that failed although the header does not name them: false failures of a correct program."""
        named = {*self.known.caught_by, *self.known.also_fails}
        if self.known.caught_by:
            named.update(self.for_any_fault)
        return [check_id for check_id in self.failed() if check_id not in named]

    def surprises(self) -> list[str]:
        """Describe each difference from the expected verdict; empty if there is none."""
        words = [f"{check_id} did not catch it ({self.status(check_id)})" for check_id in self.missed()]
        for check in self.grade.checks:
            # only the first cause is reported
            if check.status == "error" and "was not graded" not in check.help:
                words.append(f"{check.id} could not be judged: {check.help.splitlines()[0]}")
            elif check.id in self.unexpected():
                words.append(f"{check.id} failed: expected {check.expected}; observed {check.observed}")
        if self.grade.status == "not graded" and not words:
            words.append(f"not graded: {self.grade.reason}")
        if self.known.kind == "correct" and not self.grade.all_passed and not words:
            words.append("not every check passed")
        return words

    def to_json(self) -> dict[str, Any]:
        """Return what `course audit --json` writes about this run."""
        return {
            "submission": self.known.name,
            "about": self.known.about,
            "repetition": self.repetition,
            "seconds": round(self.seconds, 2),
            "caught_by": list(self.known.caught_by),
            "also_fails": list(self.known.also_fails),
            "surprises": self.surprises(),
            "grade": self.grade.to_json(),
        }


def audit(
    submissions: Sequence[KnownSubmission],
    exercise: Exercise,
    record: AuditRecord,
    report: Callable[[AuditedRun, bool], None],
    *,
    jobs: int,
    repeat: int = 1,
    seed: int = 0,
    grade_one: Callable[..., AuditedRun] | None = None,
) -> list[AuditedRun]:
    """Grade each submission `repeat` times with `jobs` parallel arenas; retry submissions without a grade once, alone.

    Runs that `record` has already are reused; all others are added to it. `report` is called with each finished run and
    with whether it was reused. `grade_one` grades a submission; None: `audit_one`. All runs are returned, in the order
    of the submissions.

    Faulty submissions share arenas, one after another. All other submissions, and those that are retried alone, have
    arenas of their own.
    The scenarios' inputs are drawn with `seed`, `seed` + 1, … for the repetitions. Ctrl-C ends the running arenas at
    once.
    """
    grade_one = grade_one or audit_one
    for known in submissions:
        require_known_checks(known, [check.id for check in exercise.checks])
    wanted = [(known, repetition) for repetition in range(repeat) for known in submissions]
    runs: dict[tuple[KnownSubmission, int], AuditedRun] = {}
    for known, repetition in wanted:
        if run := record.earlier_run(known, exercise, repetition, seed + repetition):
            runs[known, repetition] = run
            report(run, True)
    left = [one for one in wanted if one not in runs]

    def keep(run: AuditedRun) -> None:
        runs[run.known, run.repetition] = run
        record.add(run, exercise)
        report(run, False)

    stop = Stop()
    with SubmissionArenas(exercise.scenario_file) as shared, ThreadPoolExecutor(jobs) as pool:

        def start(known: KnownSubmission, repetition: int) -> Future[AuditedRun]:
            arenas = shared if known.kind == "faulty" else None
            return pool.submit(
                grade_one, known, exercise, repetition, seed, record.scale, arenas=arenas, stop=stop
            )

        futures = [start(*one) for one in left]
        try:
            for future in as_completed(futures):
                if future.result().grade.status != "not graded":
                    keep(future.result())
        except BaseException:
            stop.set()
            pool.shutdown(cancel_futures=True)
            raise
    for known, repetition in left:
        if (known, repetition) not in runs:
            keep(grade_one(known, exercise, repetition, seed, record.scale))
    if runs:
        record.write()  # also when nothing was left to grade
    return [runs[one] for one in wanted]


def audit_one(
    known: KnownSubmission,
    exercise: Exercise,
    repetition: int = 0,
    seed: int = 0,
    scale: float | None = None,
    checks_without_retry: Collection[str] = (),
    arenas: SubmissionArenas | None = None,
    stop: Stop | None = None,
) -> AuditedRun:
    """Grade one submission, one arena at a time.

    `checks_without_retry`: the checks that are not retried when they fail. `arenas`: the arenas to use; None: new ones.
    `stop`: ends the arenas at once when it is set.
    """
    started = time.monotonic()
    options = GradingOptions(
        seed + repetition, 1, scale, checks_without_retry=checks_without_retry, shortens=False
    )
    result = grade(known.read(), exercise, options, arenas=arenas, stop=stop)
    return AuditedRun(known, repetition, result, time.monotonic() - started, for_any_fault(exercise))


def for_any_fault(exercise: Exercise) -> frozenset[str]:
    """Return the ids of the checks that any faulty submission may fail."""
    return frozenset(check.id for check in exercise.checks if check.can_catch_any_fault)


def unproved_checks(runs: Sequence[AuditedRun], exercise: Exercise) -> list[str]:
    """Return the checks that failed for no submission that names them, so that the audit does not prove their use."""
    proved = {
        check_id for run in runs for check_id in run.known.caught_by if run.status(check_id) == "failed"
    }
    return [check.id for check in exercise.checks if check.id not in proved]
