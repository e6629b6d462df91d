"""Writes the pages with questions: one for each student to print, one with the keys for the examiner, and a table."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from autograder.atomic_file import write_atomically
from autograder.classroom.export.tables import csv_text, text_cell
from autograder.classroom.questions.formgrader import write_notebook
from autograder.classroom.questions.question import LETTERS, Sheet, html_of
from autograder.report.rendering import write_html

STUDENTS, EXAMINER, TABLE = "students", "examiner.html", "questions.csv"
COLUMNS = ("student_id", "exercise", "question", "part", "kind", "line", "situation", "asked", "key")


def write_pages(out: Path, exercise: str, sheets: Sequence[Sheet]) -> None:
    """Write all pages of an exercise; the students' pages contain no keys."""
    for sheet in sheets:
        if sheet.questions:
            title = f"{exercise} · {sheet.student}: questions about your program"
            page = out / STUDENTS / f"{sheet.student}.html"
            write_html(page, "questions.html", title=title, sheets=[sheet], with_keys=False, html_of=html_of)
            write_notebook(out / STUDENTS, sheet)
    title = f"{exercise}: questions with keys"
    write_html(out / EXAMINER, "questions.html", title=title, sheets=sheets, with_keys=True, html_of=html_of)
    rows: list[list[str | float]] = [
        [
            *(text_cell(sheet.student), exercise, number, LETTERS[place], one.kind, one.line),
            *map(text_cell, (one.situation, part.asked, part.key)),
        ]
        for sheet in sheets
        for number, one in enumerate(sheet.questions, 1)
        for place, part in enumerate(one.parts)
    ]
    write_atomically(out / TABLE, csv_text(COLUMNS, rows))
