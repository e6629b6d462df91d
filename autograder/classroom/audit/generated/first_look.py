"""Grades a mutant for an audit, and stops as soon as the first failing check is known."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

from autograder.classroom.audit.generated.mutant import Mutant
from autograder.classroom.audit.known_submission import KnownSubmission
from autograder.classroom.audit.run import AuditedRun
from autograder.engine.exercise import Exercise, file_names
from autograder.engine.grading import GradingOptions, Watcher, grade
from autograder.engine.judging import verdict_on
from autograder.engine.stop import Stop
from autograder.engine.submission import Submission
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.isolation.availability import available_isolation


@dataclass(frozen=True)
class GeneratedFault(KnownSubmission):
    """A mutant as a faulty submission without a file. It must fail at least one check, no matter which."""

    mutant: Mutant = field(kw_only=True)

    @property
    def name(self) -> str:
        """The mutant's name in the audit record."""
        return self.mutant.name

    def read(self) -> Submission:
        """Return the submission."""
        (file_name,) = file_names(self.exercise)
        return Submission(self.exercise, self.name, {file_name: self.mutant.source})


@dataclass(frozen=True)
class Judged:
    """A mutant and its grading."""

    mutant: Mutant
    run: AuditedRun

    @property
    def is_graded(self) -> bool:
        """Whether the grader could judge the mutant."""
        return self.run.grade.status == "graded"

    @property
    def noticed_by(self) -> CheckVerdict | None:
        """The first visible check that failed; if there is none, the first hidden check that failed."""
        failed = [check for check in self.run.grade.checks if check.status == "failed" and self.is_graded]
        return min(failed, key=lambda check: check.hidden, default=None)


class _FirstFailureFound(Exception):
    """Raised to end the grading of a mutant whose first failing check is known."""


def as_fault(mutant: Mutant, exercise: Exercise) -> GeneratedFault:
    """Return the mutant as a faulty submission, so that it shares arenas with the others."""
    ids = tuple(check.id for check in exercise.checks)
    return GeneratedFault(
        exercise.name, "faulty", mutant.base, mutant.sentence, also_fails=ids, mutant=mutant
    )


def first_look(
    known: KnownSubmission,
    exercise: Exercise,
    repetition: int = 0,
    seed: int = 0,
    scale: float | None = None,
    arenas: SubmissionArenas | None = None,
    stop: Stop | None = None,
) -> AuditedRun:
    """Grade a mutant until a visible check fails, or until all visible checks have passed and a hidden check fails.

    A failed check is not retried, because no student loses points here. The checks that were not judged before the end
    are “not run”.
    """
    started = time.monotonic()
    verdicts: dict[str, CheckVerdict] = {}
    visible = {check.id for check in exercise.checks if not check.hidden}

    def report(verdict: CheckVerdict) -> None:
        verdicts[verdict.id] = verdict
        failed = [one for one in verdicts.values() if one.status == "failed"]
        if any(not one.hidden for one in failed) or (failed and visible <= verdicts.keys()):
            raise _FirstFailureFound

    try:
        every = [check.id for check in exercise.checks]
        options = GradingOptions(seed + repetition, 1, scale, checks_without_retry=every, shortens=False)
        result = grade(known.read(), exercise, options, Watcher(report), arenas=arenas, stop=stop)
    except _FirstFailureFound:
        settled = {one.id: one for one in verdicts.values() if one.status != "error"}
        checks = [settled.get(check.id) or verdict_on(check, "not run") for check in exercise.checks]
        isolation = available_isolation().label
        result = Grade(exercise.name, known.name, isolation, checks, seed=seed + repetition)
    return AuditedRun(known, repetition, result, time.monotonic() - started)
