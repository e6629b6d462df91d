"""Makes the mutants of an exercise, grades some of them, and prints the results."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from autograder.classroom.audit.audit_record import AuditRecord
from autograder.classroom.audit.generated.first_look import Judged, as_fault, first_look
from autograder.classroom.audit.generated.mutant import Mutant, mutants_of_exercise
from autograder.classroom.audit.generated.selection import (
    EQUIVALENT,
    equivalents,
    is_one_of,
    selected,
    usual_number,
)
from autograder.classroom.audit.known_submission import KNOWN, HeaderError, KnownSubmission
from autograder.classroom.audit.run import AuditedRun, audit
from autograder.engine.exercise import Exercise

GOAL, GOAL_OF_VISIBLE = 98, 75  # percent of mutants that lose points at all, and by visible checks alone


def audit_generated(
    exercise: Exercise,
    record: AuditRecord,
    console: Console,
    *,
    number: int | None = None,
    only: str = "*",
    jobs: int = 2,
    seed: int = 0,
    scale: float | None = None,
) -> list[Judged]:
    """Grade up to `number` mutants (None: the usual number), from each operator in turn; print and return them."""
    made = mutants_of_exercise(exercise.name)
    reasons = equivalents(exercise.name)
    mistakes = [mutant for mutant in made if not any(is_one_of(patterns, mutant) for patterns in reasons)]
    chosen = selected(mistakes, number or usual_number(exercise), seed=seed, only=only)
    faults = {mutant.name: as_fault(mutant, exercise) for mutant in chosen}
    judged: list[Judged] = []

    def add(run: AuditedRun, mark: str = "") -> None:
        judged.append(Judged(faults[run.known.name].mutant, run))
        _print_judged(console, judged[-1], f"{len(judged)} of {len(faults)}{mark}")

    def earlier(known: KnownSubmission, repetition: int) -> AuditedRun | None:
        if run := record.earlier_run(known, exercise, repetition, seed):
            add(run, ", kept")
        return run

    def keep(run: AuditedRun) -> None:
        record.add(run, exercise)
        add(run)

    same = len(made) - len(mistakes)
    console.print(
        f"{exercise.name}: {len(made)} mutants made, {same} equivalent, {len(faults)} to grade", markup=False
    )
    for patterns in reasons:
        if not any(is_one_of(patterns, mutant) for mutant in made):
            console.print(f"{KNOWN}/{EQUIVALENT}: no mutant is like “{patterns}” any more", markup=False)
    audit(
        [*faults.values()],
        exercise,
        jobs=jobs,
        seed=seed,
        scale=scale,
        earlier=earlier,
        report=keep,
        grade_one=first_look,
    )
    if judged:
        record.write()  # also when nothing was left to grade
        console.print(_table(mistakes, judged))
        for line in (*survivors(exercise.name, judged), *figures(judged)):
            console.print(line, markup=False, soft_wrap=True)
    return judged


def mutant_named(exercise: str, name: str) -> Mutant:
    """Return the mutant of this name; raises `HeaderError` if there is none."""
    for mutant in mutants_of_exercise(exercise):
        if mutant.name == name:
            return mutant
    raise HeaderError(
        f"there is no mutant {name} of {exercise}; ./course audit {exercise} --generated names them"
    )


def figures(judged: Sequence[Judged]) -> list[str]:
    """Return how many lost points, and how many by visible checks alone, each as a line."""
    graded = [one for one in judged if one.is_graded]
    noticed = [check for one in graded if (check := one.noticed_by)]
    visible = [check for check in noticed if not check.hidden]
    whole = len(graded) or 1
    return [
        f"{len(noticed)} of {len(graded)} lost points: {100 * len(noticed) / whole:.0f} % (goal {GOAL} %)",
        f"{len(visible)} by visible checks: {100 * len(visible) / whole:.0f} % (goal {GOAL_OF_VISIBLE} %)",
        *([f"{len(judged) - len(graded)} could not be graded"] if len(graded) < len(judged) else []),
    ]


def survivors(exercise: str, judged: Sequence[Judged]) -> list[str]:
    """Return the diffs of the mutants with full marks or without a grade, as lines, and what to do about them."""
    lines = []
    for one in judged:
        if not one.noticed_by:
            why = "kept full marks" if one.is_graded else f"was not graded: {one.run.grade.reason}"
            changes = (f"      {line}" for line in one.mutant.diff(context=0)[3:])
            lines += [f"{one.mutant.name} {why}", f"    {one.mutant.sentence}", *changes, ""]
    if lines:
        lines += [
            "Compare each with the task's clauses. If it breaks one, fix that clause's obligation in "
            f"solutions/{exercise}/, and add scenarios if needed, so that all mistakes of this kind lose points.",
            f"If it breaks none, write a line “NAME * # why” into solutions/{exercise}/{KNOWN}/{EQUIVALENT}.",
            "",
        ]
    return lines


def _print_judged(console: Console, judged: Judged, place: str) -> None:
    noticed, seconds = judged.noticed_by, f"{judged.run.seconds:.0f} s, {place}"
    if noticed:
        by = f"{'hidden' if noticed.hidden else 'visible'} {noticed.id}"
        line = Text.assemble(("✓ ", "green"), f"{judged.mutant.name}  ", (f"{by}, {seconds}", "dim"))
    else:
        why = "full marks" if judged.is_graded else "not graded"
        line = Text(f"✗ {judged.mutant.name}  {why}, {seconds}\n    {judged.mutant.sentence}", "red")
    console.print(line, soft_wrap=True)


def _table(mistakes: Sequence[Mutant], judged: Sequence[Judged]) -> Table:
    """Return a table of the results, one row per operator."""
    table = Table("operator", "made", "graded", "lost points", "by visible", show_edge=False)
    for operator in dict.fromkeys(mutant.operator for mutant in mistakes):
        made = [mutant for mutant in mistakes if mutant.operator == operator]
        ours = [one for one in judged if one.mutant.operator == operator]
        noticed = [check for one in ours if (check := one.noticed_by)]
        numbers = len(made), len(ours), len(noticed), sum(not check.hidden for check in noticed)
        style = "bold red" if len(noticed) < len(ours) else ""
        table.add_row(operator, *map(str, numbers), style=style)
    return table
