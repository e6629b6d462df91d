"""Grades an upload with the visible checks of its exercise, and makes results.json."""

from __future__ import annotations

import os
from datetime import datetime, timezone

from autograder.classroom.batch.collection import Work, files_of_exercises, works_of
from autograder.classroom.batch.grades_without_run import unreadable
from autograder.classroom.export.gradescope import Results, render
from autograder.classroom.export.published import NOT_GRADED, Options
from autograder.classroom.on_gradescope.container import Container
from autograder.engine.exercise import Exercise, load_exercise, submission_names
from autograder.engine.grading import GradingOptions, grade
from autograder.engine.submission import UnusableSubmission
from autograder.engine.verdict import Grade
from autograder.isolation.availability import Isolation

STUDENT = "you"
WITHOUT_SCORE = Results(output=NOT_GRADED)


def grade_upload(container: Container, exercise: str, isolation: Isolation) -> Results:
    """Grade the upload.

    Args:
        container: the container with the upload.
        exercise: the assignment's exercise; "" if the names of the uploaded files decide.
        isolation: the isolation of the student's program.
    """
    found_works = works_of(container.submission, files_of_exercises())
    works = [work for work in found_works if exercise in ("", work.exercise)]
    if not exercise and len(works) != 1:
        found = f"found {', '.join(work.exercise for work in works)}" if works else "found none"
        return Results(
            score=0, output=f"Expected the file of one exercise, with the exercise's name; {found}."
        )
    loaded = load_exercise(exercise or works[0].exercise, hidden=False)
    result = _grade(works[0] if works else None, loaded, isolation)
    return Results.model_validate_json(render(result, Options(datetime.now(timezone.utc))))


def _grade(work: Work | None, exercise: Exercise, isolation: Isolation) -> Grade:
    try:
        if work is None:
            names = " nor ".join(submission_names(exercise.name))
            raise UnusableSubmission(f"the upload holds neither {names}")
        submission = work.read()
    except UnusableSubmission as error:
        return unreadable(STUDENT, exercise, isolation.label, 0, str(error))
    return grade(submission, exercise, GradingOptions(jobs=os.cpu_count() or 1, isolation=isolation))
