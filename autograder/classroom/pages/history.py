"""What the class failed at on each day on which it was graded, for the class page and `course export`."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from autograder.atomic_file import write_atomically
from autograder.classroom.export.tables import csv_text, text_cell
from autograder.classroom.pages.figures import exercise_figures
from autograder.engine.verdict import Grade

FILE = "class_history.csv"
HIDDEN = "hidden"


class Row(NamedTuple):
    """A check that submissions failed on a day: how many of those on which it was run, its clause, and its lesson."""

    day: str
    exercise: str
    check: str
    title: str
    visibility: str
    failed: str
    judged: str
    clause: str
    lesson: str

    @property
    def in_words(self) -> str:
        """The share that failed, and the day."""
        return f"{100 * int(self.failed) / int(self.judged):.0f} % on {self.day}"


def read_history(folder: Path) -> list[Row]:
    """Return the rows stored in a folder; those that are damaged are left out."""
    try:
        lines = list(csv.reader((folder / FILE).read_text(encoding="utf-8").splitlines()))[1:]
    except (OSError, ValueError, csv.Error):
        return []
    full = [Row(*line) for line in lines if len(line) == len(Row._fields)]
    return [row for row in full if row.failed.isdecimal() and row.judged.isdecimal() and int(row.judged)]


def with_day(earlier: Sequence[Row], day: str, grades: Sequence[Grade]) -> list[Row]:
    """Return the rows with those of a day, in place of this day's earlier ones; a day without a change adds none."""
    rows = [row for row in earlier if row.day != day]
    for its in exercise_figures(grades):
        now = [
            Row(
                *(day, its.exercise, check.id, check.title, HIDDEN if check.hidden else "visible"),
                *(str(check.failed), str(check.graded - check.not_run), check.clause, check.lesson),
            )
            for check in its.hardest
        ]
        ours = [row for row in rows if row.exercise == its.exercise]
        if [row[1:] for row in now] != [row[1:] for row in ours if row.day == ours[-1].day]:
            rows += now
    return rows


def history_text(rows: Iterable[Row]) -> str:
    """Return the rows as a table for spreadsheets."""
    return csv_text(Row._fields, [list(map(text_cell, row)) for row in rows])


def write_history(folder: Path, rows: Sequence[Row]) -> None:
    """Store the rows in a folder."""
    write_atomically(folder / FILE, history_text(rows))
