"""Makes the mutants of an exercise, grades some of them, and prints the results."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Sequence
from fnmatch import fnmatchcase

from rich.console import Console
from rich.table import Table
from rich.text import Text

from autograder.classroom.audit.audit_record import AuditRecord
from autograder.classroom.audit.generated.first_look import Judged, as_fault, first_look
from autograder.classroom.audit.generated.mutant import Mutant, mutants_of_exercise
from autograder.classroom.audit.known_submission import KNOWN
from autograder.classroom.audit.run import AuditedRun, audit
from autograder.engine.exercise import Exercise, exercises_folder
from autograder.report.console import BAD
from ros_runtime.course_error import CourseError

GOAL_PERCENT = 98  # of the graded mutants should lose points
VISIBLE_GOAL_PERCENT = 75  # of the graded mutants should lose points in visible checks
EQUIVALENT = "equivalent.txt"  # in an exercise's known/
DEFAULT_NUMBER = 60  # mutants to grade
DEFAULT_NUMBER_WITH_ROBOT = 30  # mutants to grade if the robot moves, because each grading then takes minutes


def audit_generated(
    exercise: Exercise,
    record: AuditRecord,
    console: Console,
    *,
    number: int | None = None,
    only: str = "*",
    jobs: int = 2,
    seed: int = 0,
) -> list[Judged]:
    """Grade up to `number` mutants (None: the default), chosen from each operator in turn; print and return them."""
    made = mutants_of_exercise(exercise.name)
    reasons = equivalents(exercise.name)
    mistakes = [mutant for mutant in made if not any(is_one_of(patterns, mutant) for patterns in reasons)]
    chosen = selected(mistakes, number or default_number(exercise), seed=seed, only=only)
    faults = {mutant.name: as_fault(mutant, exercise) for mutant in chosen}
    judged: list[Judged] = []

    def add(run: AuditedRun, is_reused: bool) -> None:
        judged.append(Judged(faults[run.known.name].mutant, run))
        place = f"{len(judged)} of {len(faults)}{', reused' if is_reused else ''}"
        _print_judged(console, judged[-1], place)

    same = len(made) - len(mistakes)
    console.print(
        f"{exercise.name}: {len(made)} mutants made, {same} equivalent, {len(faults)} to grade", markup=False
    )
    for patterns in reasons:
        if not any(is_one_of(patterns, mutant) for mutant in made):
            console.print(f"{KNOWN}/{EQUIVALENT}: no mutant matches “{patterns}” any more", markup=False)
    audit([*faults.values()], exercise, record, add, jobs=jobs, seed=seed, grade_one=first_look)
    if judged:
        console.print(_table(mistakes, judged))
        for line in (*survivors(exercise.name, judged), *figures(judged)):
            console.print(line, markup=False, soft_wrap=True)
    return judged


def mutant_named(exercise: str, name: str) -> Mutant:
    """Return the mutant of this name; raises `CourseError` if there is none."""
    for mutant in mutants_of_exercise(exercise):
        if mutant.name == name:
            return mutant
    raise CourseError(
        f"there is no mutant {name} of {exercise}; ./course audit {exercise} --generated prints the names"
    )


def figures(judged: Sequence[Judged]) -> list[str]:
    """Return lines that say how many mutants lost points, and how many lost points in visible checks."""
    graded = [one for one in judged if one.is_graded]
    noticed = [check for one in graded if (check := one.noticed_by)]
    visible = [check for check in noticed if not check.hidden]
    whole = len(graded) or 1
    return [
        f"{len(noticed)} of {len(graded)} lost points: {100 * len(noticed) / whole:.0f} % (goal {GOAL_PERCENT} %)",
        f"{len(visible)} by visible checks: {100 * len(visible) / whole:.0f} % (goal {VISIBLE_GOAL_PERCENT} %)",
        *([f"{len(judged) - len(graded)} could not be graded"] if len(graded) < len(judged) else []),
    ]


def survivors(exercise: str, judged: Sequence[Judged]) -> list[str]:
    """Return the diffs of the mutants that kept full marks or were not graded, and what to do about them, as lines."""
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
        line = Text(f"✗ {judged.mutant.name}  {why}, {seconds}\n    {judged.mutant.sentence}", BAD)
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


def default_number(exercise: Exercise) -> int:
    """Return the default number of mutants to grade."""
    is_light = all(scenario.is_light for check in exercise.checks for scenario in check.on)
    return DEFAULT_NUMBER if is_light else DEFAULT_NUMBER_WITH_ROBOT


def equivalents(exercise: str) -> dict[str, str]:
    """Return the reasons why mutants are equivalent, by (pattern of names, pattern of sentences).

    Raises `CourseError` for a line that is not “NAME SENTENCE # reason”.
    """
    path = exercises_folder() / exercise / KNOWN / EQUIVALENT
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    found = {}
    for number, line in enumerate(lines, start=1):
        patterns, _, reason = (part.strip() for part in line.partition(" # "))
        if line.strip() and not line.startswith("#"):
            if not reason or " " not in patterns:
                raise CourseError(
                    f"{path}, line {number}: expected “<pattern of names> <pattern of sentences> # why these are no "
                    "mistakes”"
                )
            found[patterns] = reason
    return found


def is_one_of(patterns: str, mutant: Mutant) -> bool:
    """Whether a mutant's name and sentence match a line of `equivalents`."""
    name, _, sentence = patterns.partition(" ")
    return fnmatchcase(mutant.name, name) and fnmatchcase(mutant.sentence, sentence.strip())


def selected(mutants: Sequence[Mutant], number: int, *, seed: int = 0, only: str = "*") -> list[Mutant]:
    """Return up to `number` mutants whose name matches `only`: from each operator in turn, from each base in turn.

    The order within an operator depends only on the seed and on each mutant's name, so that a new mutant does not
    change the order of the others.
    """
    waiting: dict[str, list[Mutant]] = {}
    for mutant in sorted(mutants, key=lambda mutant: _drawn(mutant, seed)):
        if fnmatchcase(mutant.name, only):
            waiting.setdefault(mutant.operator, []).append(mutant)
    taken: list[Mutant] = []
    from_base: Counter[str] = Counter()
    while len(taken) < number and any(waiting.values()):
        for _, ours in sorted(waiting.items()):
            if ours and len(taken) < number:
                best = min(ours, key=lambda mutant: from_base[mutant.base.stem])
                ours.remove(best)
                from_base[best.base.stem] += 1
                taken.append(best)
    return taken


def _drawn(mutant: Mutant, seed: int) -> str:
    return hashlib.sha256(f"{seed} {mutant.name}".encode()).hexdigest()
