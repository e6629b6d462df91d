"""Verdicts as tables for the terminal, and as plain text for readers that show neither tables nor drawings."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from autograder.authoring.checks import Check
from autograder.engine.exercise import Exercise
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.console import BAD, GOOD, NOTICE, OTHER

LOG_LINES = 6
NEAR_TIME = 5.0  # s before and after a failure, in which lines of the log may tell why

MARKS = {
    "passed": ("✓", GOOD),
    "failed": ("✗", BAD),
    "not run": ("–", NOTICE),
    "error": ("!", NOTICE),
    "to mark": ("…", OTHER),
    "marked": ("•", OTHER),
}
SHOWN = {"error": "not graded"}  # what the tables call a status
LONGEST_TEXT = 8000  # characters
_LINE_TIME = re.compile(r" *(\d+\.\d\d) s  ")


def print_beginning(console: Console, path: Path, exercise: Exercise) -> None:
    """Print what is checked and how long it takes, before the first verdict."""
    count = len(exercise.checks)
    console.print(f"{path}: {count} checks, each shown as soon as its verdict is known.", markup=False)


def print_verdict(console: Console, verdict: CheckVerdict) -> None:
    """Print one verdict, with the reason unless it is 'passed'."""
    mark, colour = MARKS[verdict.status]
    console.print(Text.assemble((f"{mark} ", colour), verdict.title, (f"  {_points(verdict)}", "dim")))
    reason = explanation(verdict)
    if reason.row_count:
        console.print(Padding.indent(reason, 4))


def print_retry(console: Console, check: Check) -> None:
    """Print that a check failed once and is retried."""
    console.print(Text(f"… {check.title}: failed once, retrying", "dim"))


def explanation(verdict: CheckVerdict) -> Table:
    """Return a table with expected, observed with its time, next step, and the end of the program's output."""
    table = Table.grid(padding=(0, 2), pad_edge=False)
    table.add_column(style="bold", no_wrap=True)
    table.add_column(overflow="fold")
    if verdict.status == "passed":
        return table
    when = f"  (at {verdict.robot_time:.1f} s)" if verdict.robot_time is not None else ""
    for label, text in reasons(verdict).items():
        table.add_row(label, Text.assemble(text, (when if label == "observed" else "", "dim")))
    for line in _near_the_failure(verdict):
        table.add_row("log", Text(line, "dim"))
    return table


def reasons(verdict: CheckVerdict) -> dict[str, str]:
    """Return what was expected, what was observed and what to do next, as far as there is a text for it."""
    texts = {"expected": verdict.expected, "observed": verdict.observed, "next": verdict.help}
    return {label: text for label, text in texts.items() if text}


def _near_the_failure(verdict: CheckVerdict) -> list[str]:
    """Return the last lines of the log from about the time of the failure; if there are none, the last lines of all."""
    lines = verdict.log.splitlines()
    at = verdict.robot_time
    timed = [(_LINE_TIME.match(line), line) for line in lines]
    near = [line for time, line in timed if time and at is not None and abs(float(time[1]) - at) <= NEAR_TIME]
    return (near or lines)[-LOG_LINES:]


def summary(grade: Grade) -> str:
    """Return the score in one line, or "not graded" or "to be marked"; without isolation it is labelled."""
    if grade.status == "not graded":
        return f"NOT GRADED, no score: {grade.why_not_graded}"
    if grade.status == "to mark":
        waiting = sum(verdict.status == "to mark" for verdict in grade.checks)
        return f"to be marked by hand: {waiting} of {len(grade.checks)} criteria"
    label = "" if grade.isolation == "namespaces" else f"  [{grade.isolation}]"
    before = f" ({grade.earned:g} before the deduction for late work)" if grade.score != grade.earned else ""
    return f"{grade.score:g} of {grade.max_score} points{before}{label}"


def _points(verdict: CheckVerdict) -> str:
    return f"{verdict.points}/{verdict.max_points}"


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
            table.add_row(grade.student, grade.exercise, Text("not graded", NOTICE), why)
        elif grade.status == "to mark":
            table.add_row(
                grade.student, grade.exercise, Text("to mark", MARKS["to mark"][1]), Text(summary(grade))
            )
        else:
            table.add_row(
                grade.student, grade.exercise, f"{grade.score:g}/{grade.max_score}", Text(_lost_at(grade))
            )
    return table


def progress_line(grade: Grade, *, cached: bool = False) -> Text:
    """Return the line to print when one submission is graded."""
    colours = {"not graded": NOTICE, "to mark": MARKS["to mark"][1]}
    colour = colours.get(grade.status, GOOD if grade.all_passed else NOTICE)
    note = "  (the same program was graded before)" if cached else ""
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


def verdict_text(verdict: CheckVerdict, longest: int = LONGEST_TEXT) -> str:
    """Return what was expected, what was observed and when, what to do next, and what the program printed.

    Nothing is left out, so the text of a hidden check's verdict is for instructors only.
    """
    lines = [verdict.status.capitalize() + "."]
    lines += [f"{label.capitalize()}: {text}" for label, text in reasons(verdict).items()]
    if verdict.robot_time is not None:
        lines.append(f"At {verdict.robot_time:.1f} s.")
    if verdict.log and verdict.status != "passed":
        lines.append(f"What the program printed:\n{verdict.log}")
    text = "\n".join(lines)
    return text if len(text) <= longest else f"{text[:longest]}\n… cut here"
