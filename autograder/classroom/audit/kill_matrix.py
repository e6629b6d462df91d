"""The kill matrix: one row for each submission, one column for each check."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console, Group, RenderableType
from rich.table import Table
from rich.text import Text

from autograder.classroom.audit.run import AuditedRun, unproved_checks
from autograder.engine.exercise import Exercise
from autograder.report.console import BAD, GOOD, OTHER
from autograder.report.table import MARKS

KILL = ("✗", "bold green")  # a check failed that must fail, by the submission's header
CONSEQUENCE = ("✗", OTHER)  # a check failed that may fail, by the submission's header
SURPRISE = "bold white on red"  # the verdict is not as the header says


def print_progress(console: Console, run: AuditedRun, *, earlier: bool = False) -> None:
    """Print one finished run, with each difference from the expected verdict; `earlier`: it is reused from a record."""
    surprises = run.surprises()
    mark, colour = ("✗", BAD) if surprises else ("✓", GOOD)
    score = run.grade.score if run.grade.score is not None else "not graded"
    points = f"{score}/{run.grade.max_score}  " if run.grade.max_score else ""  # none on another robot
    facts = f"{points}{run.seconds:.0f} s{'  (reused)' if earlier else ''}"
    console.print(Text.assemble((f"{mark} ", colour), f"{run.known.name}  ", (facts, "dim")))
    for surprise in surprises:
        console.print(Text(f"    {surprise}", colour))


def kill_matrix(runs: Sequence[AuditedRun], exercise: Exercise) -> RenderableType:
    """Return the matrix of one exercise, with its legend and figures."""
    table = Table(
        title=f"Kill matrix of {exercise.name}", title_justify="left", show_edge=False, padding=(0, 1, 0, 0)
    )
    table.add_column("submission", no_wrap=True)
    for number in range(1, len(exercise.checks) + 1):
        table.add_column(str(number), justify="center", no_wrap=True)
    table.add_column("s", justify="right")
    kind = ""
    for run in sorted(runs, key=_order):
        if kind and run.known.kind != kind:
            table.add_section()
        kind = run.known.kind
        name = run.known.name + (f" #{run.repetition + 1}" if run.repetition else "")
        table.add_row(name, *(_cell(run, check.id) for check in exercise.checks), f"{run.seconds:.0f}")
    return Group(table, Text(), _legend(runs, exercise), Text(), *map(Text, figures(runs, exercise)))


def figures(runs: Sequence[AuditedRun], exercise: Exercise) -> list[str]:
    """Return the figures of the audit, each as a line."""
    faulty = [run for run in runs if run.known.kind == "faulty" and run.known.caught_by]
    killed = [run for run in faulty if not run.missed()]
    correct = [run for run in runs if run.known.kind == "correct"]
    others = [run for run in runs if run.known.kind != "correct"]
    lines = [
        f"kills: {len(killed)} of {len(faulty)} faulty submissions ({_percent(killed, faulty)})",
        f"false failures: {_unexpected(correct)} in {len(correct)} runs of correct submissions",
        f"unexpected failures: {_unexpected(others)} in {len(others)} runs of faulty and hostile ones",
        f"not graded: {sum(run.grade.status == 'not graded' for run in runs)} of {len(runs)}",
    ]
    if unproved := unproved_checks(runs, exercise):
        lines.append(f"checks that caught no fault: {', '.join(unproved)}")
    return lines


def _order(run: AuditedRun) -> tuple[int, str, int]:
    return ("correct", "faulty", "hostile").index(run.known.kind), run.known.name, run.repetition


def _cell(run: AuditedRun, check_id: str) -> Text:
    status = run.status(check_id)
    mark, colour = MARKS[status]
    if status == "error" or check_id in run.unexpected() or check_id in run.missed():
        return Text(mark, SURPRISE)
    if check_id in run.known.caught_by:
        return Text(*KILL)
    if status == "failed":
        return Text(*CONSEQUENCE)
    return Text(mark, f"dim {colour}")


def _legend(runs: Sequence[AuditedRun], exercise: Exercise) -> RenderableType:
    legend = Table.grid(padding=(0, 2, 0, 0))
    for number, check in enumerate(exercise.checks, start=1):
        submissions = {run.known.name for run in runs if check.id in run.known.caught_by}
        legend.add_row(
            str(number), check.id, "hidden" if check.hidden else "", f"must catch {len(submissions)}"
        )
    key = Text.assemble(
        "✓ passed  ",
        ("✗", KILL[1]),
        " caught the fault  ",
        ("✗", CONSEQUENCE[1]),
        " consequence of the fault  – not run  ! not judged  ",
        (" red ", SURPRISE),
        " not as expected",
    )
    return Group(legend, key)


def _unexpected(runs: Sequence[AuditedRun]) -> int:
    return sum(len(run.unexpected()) for run in runs)


def _percent(part: Sequence[object], whole: Sequence[object]) -> str:
    return f"{100 * len(part) / len(whole):.0f} %" if whole else "none"
