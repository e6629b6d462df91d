"""Grades for submissions that cannot be read, and for submissions that could not be judged."""

from __future__ import annotations

import dataclasses

from autograder.engine.exercise import Exercise
from autograder.engine.verdict import CheckVerdict, Grade


def unreadable(student: str, exercise: Exercise, isolation: str, seed: int, problem: str) -> Grade:
    """Return the grade of an unreadable submission: no points, and the reason in the verdict of the first check."""
    first, *others = exercise.checks
    names = " and ".join(exercise.file_names)
    verdicts = [
        CheckVerdict(
            first.id,
            first.title,
            "failed",
            0,
            first.points,
            expected=f"{names}, or a notebook with cells that begin '%%writefile {exercise.file_names[0]}'",
            observed=problem,
            help="Open the file you handed in, correct this and hand it in again.",
        ),
        *(
            CheckVerdict(
                check.id,
                check.title,
                "not run",
                0,
                check.points,
                help="The submission could not be read.",
                hidden=check.hidden,
            )
            for check in others
        ),
    ]
    return Grade(exercise.name, student, isolation, verdicts, seed=seed)


def with_reason(grade: Grade) -> Grade:
    """Return the grade; a missing reason of "not graded" is taken from the first check that was not judged."""
    if grade.status == "graded" or grade.reason:
        return grade
    broken = next((verdict for verdict in grade.checks if verdict.status == "error"), None)
    return dataclasses.replace(
        grade, reason=f"{broken.id}: {broken.help}" if broken else "no check was judged"
    )
