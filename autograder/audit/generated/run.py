"""Makes the mutants of an exercise, and grades some of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from autograder.audit.audit_record import AuditRecord
from autograder.audit.generated.fault import Judged, as_faults
from autograder.audit.generated.mutant import Mutant, mutants_of_exercise
from autograder.audit.generated.selection import equivalents, selected, usual_number
from autograder.audit.known_submission import HeaderError, KnownSubmission
from autograder.audit.run import AuditedRun, audit
from autograder.engine.exercise import Exercise


@dataclass(frozen=True)
class GeneratedAudit:
    """What was made for an exercise, which of that is equivalent, by name with a reason, and what was graded."""

    made: Sequence[Mutant]
    equivalent: dict[str, str]
    judged: Sequence[Judged]

    @property
    def has_survivors(self) -> bool:
        """Whether one kept full marks, or could not be graded."""
        return not all(one.lost_points for one in self.judged)

    def outdated(self) -> list[str]:
        """Return the names of equivalents that are not made any more."""
        names = {mutant.name for mutant in self.made}
        return [name for name in self.equivalent if name not in names]


def audit_generated(
    exercise: Exercise,
    record: AuditRecord,
    *,
    number: int | None = None,
    only: str = "*",
    jobs: int = 2,
    seed: int = 0,
    scale: float | None = None,
    report: Callable[[Judged, bool], None] = lambda judged, earlier: None,
) -> GeneratedAudit:
    """Grade up to `number` mutants, of each operator in turn, with every check; the usual number if it is None.

    `report` gets each one when it is judged, and whether its grade is from the record.
    """
    made = mutants_of_exercise(exercise.name)
    equivalent = equivalents(exercise.name)
    candidates = [mutant for mutant in made if mutant.name not in equivalent]
    chosen = selected(candidates, number or usual_number(exercise), seed=seed, only=only)
    faults = as_faults(chosen, exercise)
    mutants = {fault.name: fault.mutant for fault in faults}

    def earlier(known: KnownSubmission, repetition: int) -> AuditedRun | None:
        run = record.earlier_run(known, exercise, repetition, seed)
        if run:
            report(Judged(mutants[known.name], run), True)
        return run

    def keep(run: AuditedRun) -> None:
        record.add(run, exercise)
        report(Judged(mutants[run.known.name], run), False)

    runs = audit(faults, exercise, jobs=jobs, seed=seed, scale=scale, earlier=earlier, report=keep)
    return GeneratedAudit(made, equivalent, [Judged(mutants[run.known.name], run) for run in runs])


def mutant_named(exercise: str, name: str) -> Mutant:
    """Return the mutant of this name; raises `HeaderError` if there is none."""
    for mutant in mutants_of_exercise(exercise):
        if mutant.name == name:
            return mutant
    raise HeaderError(
        f"there is no mutant {name} of {exercise}; ./course audit {exercise} --generated names them"
    )
