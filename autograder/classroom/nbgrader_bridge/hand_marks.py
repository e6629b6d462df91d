"""The points that a person gives for an essay in formgrader: reads them, and asks to confirm them for new work."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from nbgrader.api import Gradebook

from autograder.engine.verdict import CheckVerdict, Grade


def with_marks(gradebook: Gradebook, grade: Grade) -> Grade:
    """Return the grade of an essay with the points given so far; raises `MissingEntry` when it is not entered."""
    return replace(grade, checks=[_marked(gradebook, grade, verdict) for verdict in grade.checks])


def ask_again(gradebook: Gradebook, grade: Grade) -> None:
    """Mark the criteria as needing manual grading again; points for the earlier work stay and have to be confirmed."""
    for verdict in grade.checks:
        _entry(gradebook, grade, verdict).needs_manual_grade = True
    gradebook.db.commit()


def _marked(gradebook: Gradebook, grade: Grade, verdict: CheckVerdict) -> CheckVerdict:
    entry = _entry(gradebook, grade, verdict)
    if entry.needs_manual_grade:
        return replace(verdict, status="to mark", points=0)
    points = float(entry.score)
    return replace(verdict, status="marked", points=int(points) if points.is_integer() else points)


def _entry(gradebook: Gradebook, grade: Grade, verdict: CheckVerdict) -> Any:
    """Nbgrader's record of one criterion."""
    return gradebook.find_grade(verdict.id, grade.exercise, grade.exercise, grade.student)
