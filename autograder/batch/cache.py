"""A cache of grades, with which an interrupted batch is resumed."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from pathlib import Path

from autograder.atomic_file import write_atomically
from autograder.batch.records import UNREADABLE
from autograder.batch.version import checks_version
from autograder.engine.exercise import Exercise
from autograder.engine.submission import Submission
from autograder.engine.verdict import Grade
from autograder.isolation.availability import Isolation


class GradeCache:
    """Grades on disk, keyed by what they depend on: sources, checks, seed of the scenario inputs, isolation.

    A submission that could not be graded is never cached.
    """

    def __init__(self, folder: Path, isolation: Isolation) -> None:
        self._folder = folder
        self._isolation = isolation

    def get(self, submission: Submission, exercise: Exercise, seed: int) -> Grade | None:
        """Return the cached grade of a submission with the same sources, under this student's name.

        What is damaged counts as not there: it is graded again.
        """
        path = self._path(submission, exercise, seed)
        if not path.exists():
            return None
        try:
            grade = Grade.from_json(json.loads(path.read_text(encoding="utf-8")))
        except UNREADABLE:
            return None
        if grade.status != "graded" or grade.exercise != exercise.name:
            return None
        return dataclasses.replace(grade, student=submission.student)

    def put(self, submission: Submission, exercise: Exercise, seed: int, grade: Grade) -> None:
        """Cache a grade."""
        if grade.status != "graded":
            return
        path = self._path(submission, exercise, seed)
        write_atomically(path, json.dumps(grade.to_json()))

    def _path(self, submission: Submission, exercise: Exercise, seed: int) -> Path:
        key = hashlib.sha256(
            json.dumps(
                [
                    dict(submission.sources),
                    checks_version(exercise.folder),
                    [check.id for check in exercise.checks],
                    seed,
                    self._isolation.label,
                ]
            ).encode()
        )
        return self._folder / exercise.name / f"{key.hexdigest()}.json"
