"""A table of the grades of a whole class, for the terminal."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.table import MARKS, summary


def class_table(grades: Sequence[Grade]) -> RenderableType:
    """Return a table with a row for each submission: the score, and the checks that cost points."""
    table = Table(show_edge=False)
    table.add_column("student", overflow="fold")
    table.add_column("exercise")
    table.add_column("score", justify="right")
    table.add_column("lost at", overflow="fold")
    for grade in grades:
        if grade.status == "not graded":
            why = Text(grade.why_not_graded)
            table.add_row(grade.student, grade.exercise, Text("not graded", "magenta"), why)
        elif grade.status == "to mark":
            table.add_row(
                grade.student, grade.exercise, Text("to mark", MARKS["to mark"][1]), Text(summary(grade))
            )
        else:
            table.add_row(
                grade.student, grade.exercise, f"{grade.score}/{grade.max_score}", Text(_lost_at(grade))
            )
    return table


def progress_line(grade: Grade, *, cached: bool = False) -> Text:
    """Return the line to print when one submission is graded."""
    colours = {"not graded": "magenta", "to mark": MARKS["to mark"][1]}
    colour = colours.get(grade.status, "green" if grade.all_passed else "yellow")
    note = "  (as before)" if cached else ""
    return Text.assemble(
        (f"{grade.student} · {grade.exercise}  ", ""), (summary(grade).splitlines()[0], colour), (note, "dim")
    )


def _lost_at(grade: Grade) -> str:
    def words(verdict: CheckVerdict) -> str:
        return (
            verdict.id
            if verdict.status == "failed"
            else f"{verdict.id} ({verdict.points}/{verdict.max_points})"
        )

    failed = [
        words(verdict) for verdict in grade.checks if verdict.status == "failed" or _lacks_points(verdict)
    ]
    not_run = sum(verdict.status == "not run" for verdict in grade.checks)
    return ", ".join([*failed, f"{not_run} not run"] if not_run else failed)


def _lacks_points(verdict: CheckVerdict) -> bool:
    return verdict.status == "marked" and verdict.points < verdict.max_points
