"""Verdicts on a terminal."""

from __future__ import annotations

from rich.console import Console, Group, RenderableType
from rich.table import Table
from rich.text import Text

from autograder.checks import Check
from autograder.verdict import CheckVerdict, Grade

LOG_LINES = 6

MARKS = {
    "passed": ("✓", "green"),
    "failed": ("✗", "red"),
    "not run": ("–", "yellow"),
    "error": ("!", "magenta"),
}


def print_verdict(console: Console, verdict: CheckVerdict) -> None:
    """Print one verdict as soon as it is known, with the reason when it is not 'passed'."""
    mark, colour = MARKS[verdict.status]
    console.print(Text.assemble((f"{mark} ", colour), verdict.title, (f"  {_points(verdict)}", "dim")))
    for line in explanation(verdict):
        console.print(Text("    ").append_text(line))


def print_second_look(console: Console, check: Check) -> None:
    """Say that a check failed once and is looked at again."""
    console.print(Text(f"… {check.title}: failed once, looking again", "dim"))


def explanation(verdict: CheckVerdict) -> list[Text]:
    """Return what went wrong as lines: expected, observed with its time, next step, the end of the node's output."""
    if verdict.status == "passed":
        return []
    when = f"  (at {verdict.robot_time:.1f} s)" if verdict.robot_time is not None else ""
    lines = [
        Text.assemble(("expected  ", "bold"), verdict.expected) if verdict.expected else None,
        Text.assemble(("observed  ", "bold"), verdict.observed, (when, "dim")) if verdict.observed else None,
        Text.assemble(("next      ", "bold"), verdict.help) if verdict.help else None,
    ]
    log = [
        Text.assemble(("log       ", "bold"), (line, "dim")) for line in verdict.log.splitlines()[-LOG_LINES:]
    ]
    return [line for line in lines if line is not None] + log


def grade_table(grade: Grade) -> RenderableType:
    """Return the whole table of one grade with its score."""
    table = Table(title=f"{grade.exercise} · {grade.student}", title_justify="left", show_edge=False)
    table.add_column("")
    table.add_column("check", overflow="fold")
    table.add_column("points", justify="right")
    table.add_column("verdict")
    for verdict in grade.checks:
        mark, colour = MARKS[verdict.status]
        table.add_row(
            Text(mark, colour),
            verdict.title + ("  (hidden)" if verdict.hidden else ""),
            _points(verdict),
            Text(verdict.status, colour),
        )
    return Group(table, Text(summary(grade), style="bold"))


def summary(grade: Grade) -> str:
    """Return the score in one line; a grade without isolation or verdict says so."""
    if grade.status == "not graded":
        return f"NOT GRADED, no points either way{': ' + grade.reason if grade.reason else ''}"
    label = "" if grade.isolation == "namespaces" else f"  [{grade.isolation}]"
    return f"{grade.score} of {grade.max_score} points{label}"


def _points(verdict: CheckVerdict) -> str:
    return f"{verdict.points}/{verdict.max_points}"
