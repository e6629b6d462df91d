"""`nbgrader export` with the rows of `course export --format csv`, read from the gradebook.

The rows include the points that a person gave or changed in formgrader, and late penalties. nbgrader's own table has a
0 for a submission that is missing, not graded or not marked yet. This table leaves the submission out and logs it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from nbgrader.api import Gradebook, MissingEntry
from nbgrader.plugins.export import ExportPlugin

from autograder.atomic_file import write_atomically
from autograder.classroom.export.grades_csv import FILE, Row, table_text
from autograder.classroom.export.published import number
from autograder.classroom.nbgrader_bridge.course_folder import RECORDS
from autograder.classroom.nbgrader_bridge.generated_cells import HIDDEN


class ClassExport(ExportPlugin):
    """The grades of a class, one row per submission with a score."""

    def export(self, gradebook: Gradebook) -> None:
        """Write the file of nbgrader's option --to, or grades.csv in the current folder."""
        not_graded = _not_graded(gradebook)
        rows: list[Row] = []
        for student, assignment in self._wanted(gradebook):
            submission = _submission(gradebook, student, assignment)
            if submission is None:
                self.log.warning("%s of %s is missing: left out", assignment, student)
            elif (student, assignment) in not_graded:
                self.log.warning("%s of %s is not graded: left out", assignment, student)
            elif submission.needs_manual_grade:
                self.log.warning("%s of %s is not marked yet: left out", assignment, student)
            else:
                rows.append(_row(submission, student, assignment))
        path = Path(self.to or FILE)
        self.log.info("Exporting %d submissions to %s", len(rows), path)
        write_atomically(path, table_text(rows))

    def _wanted(self, gradebook: Gradebook) -> Iterator[tuple[str, str]]:
        """Yield the pairs of student and assignment that the command selects; by default all."""
        assignments, students = set(map(str, self.assignment)), set(map(str, self.student))
        for assignment in gradebook.assignments:
            for student in gradebook.students:
                if assignments and assignment.name not in assignments:
                    continue
                if not students or student.id in students:
                    yield student.id, assignment.name


def _submission(gradebook: Gradebook, student: str, assignment: str) -> Any:
    """Return nbgrader's record of a submission; None if nothing was handed in."""
    try:
        submission = gradebook.find_submission(assignment, student)
    except MissingEntry:
        return None
    return submission if submission.notebooks else None


def _row(submission: Any, student: str, assignment: str) -> Row:
    grades = [grade for notebook in submission.notebooks for grade in notebook.grades]
    hidden = [grade for grade in grades if grade.name.startswith(HIDDEN)]
    score = max(0.0, submission.score - submission.late_submission_penalty)
    return (
        student,
        assignment,
        number(score),
        number(submission.max_score),
        number(sum(grade.score for grade in hidden)),
        number(sum(grade.max_score for grade in hidden)),
    )


def _not_graded(gradebook: Gradebook) -> set[tuple[str, str]]:
    """Return the submissions not graded in the last run; the gradebook may hold an earlier score of each."""
    records = Path(gradebook.engine.url.database or "").parent / RECORDS
    found: set[tuple[str, str]] = set()
    for path in records.glob("*.json"):
        for record in json.loads(path.read_text(encoding="utf-8")):
            if record["status"] == "not graded":
                found.add((record["student"], record["exercise"]))
    return found
