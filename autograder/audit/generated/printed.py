"""An audit of generated faults as `course audit --generated` prints it."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console

from autograder.audit.audit_record import AuditRecord
from autograder.audit.generated.fault import Judged
from autograder.audit.generated.run import GeneratedAudit, audit_generated, mutant_named
from autograder.audit.generated.table import figures, print_judged, survivors, table_of_faults
from autograder.engine.exercise import load_exercise


def audit_generated_faults(
    console: Console,
    exercises: Sequence[str],
    record: AuditRecord,
    *,
    number: int | None,
    only: str,
    jobs: int,
    seed: int,
    scale: float | None,
) -> list[GeneratedAudit]:
    """Grade mutants of each exercise and print what became of them."""

    def report(judged: Judged, earlier: bool) -> None:
        print_judged(console, judged, earlier=earlier)

    audits = []
    for name in exercises:
        audited = audit_generated(
            load_exercise(name, hidden=True),
            record,
            number=number,
            only=only,
            jobs=jobs,
            seed=seed,
            scale=scale,
            report=report,
        )
        for gone in audited.outdated():
            console.print(
                f"known/equivalent.txt of {name}: no mutant is called {gone} any more", markup=False
            )
        if audited.judged:
            record.write()  # also when nothing was left to grade
            console.print()
            console.print(table_of_faults(name, audited.made, audited.equivalent, audited.judged))
            console.print()
            for line in (*survivors(audited.judged), *figures(audited.judged)):
                console.print(line, markup=False, soft_wrap=True)
            console.print()
        audits.append(audited)
    return audits


def show_mutant(exercise: str, name: str) -> None:
    """Print what a mutant changes; raises `HeaderError` if there is none of that name."""
    mutant = mutant_named(exercise, name)
    print(mutant.sentence, *mutant.diff(), sep="\n")
