"""One table of the class, with a row for each submission that has a score.

The columns have the names of nbgrader's own export, if it has the column. `nbgrader export` with
`autograder.classroom.nbgrader_bridge.class_export.ClassExport` writes the same rows from a gradebook.
"""

from __future__ import annotations

from collections.abc import Iterable

from autograder.classroom.export.published import Published
from autograder.classroom.export.tables import csv_text, text_cell

FILE = "grades.csv"
COLUMNS = ("student_id", "assignment", "score", "max_score", "hidden_score", "hidden_max_score")
Row = tuple[str, str, float, float, float, float]  # one submission, by COLUMNS


def row_of(published: Published) -> Row:
    """Return the row of a graded submission."""
    return (
        published.student,
        published.exercise,
        published.score,
        published.max_score,
        published.hidden_points,
        published.hidden_max_points,
    )


def table_text(rows: Iterable[Row]) -> str:
    """Return the file's content, in order of exercise and student."""
    in_order = sorted(rows, key=lambda row: (row[1], row[0]))
    return csv_text(COLUMNS, [(*map(text_cell, row[:2]), *row[2:]) for row in in_order])
