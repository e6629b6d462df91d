"""One table of the class: a row for each submission that has a score, and none for the others.

The names of the columns are those of nbgrader's own export, as far as it has them; `nbgrader export` with
`autograder.classroom.nbgrader_bridge.class_export.ClassExport` writes the same rows from a gradebook.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import astuple, dataclass, fields

from autograder.classroom.export.published import Published
from autograder.classroom.export.tables import csv_text, text_cell

FILE = "grades.csv"


@dataclass(frozen=True)
class Row:
    """One submission; the columns in their order."""

    student_id: str
    assignment: str
    score: float
    max_score: float
    hidden_score: float
    hidden_max_score: float


def row_of(published: Published) -> Row:
    """Return the row of a graded submission."""
    return Row(
        published.student,
        published.exercise,
        published.score,
        published.max_score,
        published.hidden_points,
        published.hidden_max_points,
    )


def table_text(rows: Iterable[Row]) -> str:
    """Return the file's content, in order of exercise and student."""
    in_order = sorted(rows, key=lambda row: (row.assignment, row.student_id))
    cells = [
        [text_cell(cell) if isinstance(cell, str) else cell for cell in astuple(row)] for row in in_order
    ]
    return csv_text([field.name for field in fields(Row)], cells)
