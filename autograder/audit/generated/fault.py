"""A mutant as the audit grades it, and what its grade says about the checks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from autograder.audit.generated.mutant import Mutant
from autograder.audit.known_submission import KnownSubmission
from autograder.audit.run import AuditedRun
from autograder.engine.exercise import Exercise, file_names
from autograder.engine.submission import Submission


@dataclass(frozen=True)
class GeneratedFault(KnownSubmission):
    """A submission that no file holds; it may fail any check, and must fail one."""

    mutant: Mutant = field(kw_only=True)

    @property
    def name(self) -> str:
        """Its name in tables and in the record."""
        return self.mutant.name

    def read(self) -> Submission:
        """Return the submission."""
        (file_name,) = file_names(self.exercise)
        return Submission(self.exercise, self.name, {file_name: self.mutant.source})


@dataclass(frozen=True)
class Judged:
    """A graded mutant."""

    mutant: Mutant
    run: AuditedRun

    @property
    def is_graded(self) -> bool:
        """Whether there is a verdict."""
        return self.run.grade.status == "graded"

    @property
    def lost_points(self) -> bool:
        """Whether a check noticed it."""
        return self.is_graded and not self.run.grade.all_passed

    @property
    def lost_by_visible(self) -> bool:
        """Whether the checks that students have would notice it: one of them failed, or was not run."""
        return self.is_graded and any(
            not check.hidden and check.status != "passed" for check in self.run.grade.checks
        )


def as_faults(mutants: Sequence[Mutant], exercise: Exercise) -> list[GeneratedFault]:
    """Return what the audit grades; these faults share arenas, as the faulty submissions do."""
    ids = tuple(check.id for check in exercise.checks)
    return [
        GeneratedFault(exercise.name, "faulty", one.base, one.sentence, also_fails=ids, mutant=one)
        for one in mutants
    ]
