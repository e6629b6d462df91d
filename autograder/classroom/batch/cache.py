"""A cache of grades, from which an interrupted batch is resumed."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter

from autograder.atomic_file import write_atomically
from autograder.classroom.batch.job import Effort
from autograder.classroom.batch.records import UNREADABLE
from autograder.classroom.batch.version import checks_version
from autograder.engine.exercise import Exercise
from autograder.engine.submission import Submission
from autograder.engine.verdict import Grade
from autograder.isolation.availability import Isolation

_EFFORTS = TypeAdapter(Effort)


@dataclass(frozen=True)
class CachedGrade:
    """An earlier grade, with the effort of the run that produced it."""

    grade: Grade
    effort: Effort


def grade_key(submission: Submission, exercise: Exercise, seed: int, isolation: Isolation, *more: Any) -> str:
    """Return a hash of everything that a grade depends on: sources, checks, robots, seed, isolation, and `more`."""
    depends_on = [
        dict(submission.sources),
        checks_version(exercise.folder),
        [[check.id, *(scenario.robot for scenario in check.on)] for check in exercise.checks],
        seed,
        isolation.label,
    ]
    return hashlib.sha256(json.dumps([*more, *depends_on]).encode()).hexdigest()


class GradeCache:
    """Grades on disk, keyed by everything that they depend on: sources, checks, seed of the inputs, isolation.

    The grade of a submission that could not be graded is never cached.
    """

    def __init__(self, folder: Path, isolation: Isolation) -> None:
        self._folder = folder
        self._isolation = isolation

    def get(self, submission: Submission, exercise: Exercise, seed: int) -> CachedGrade | None:
        """Return the cached grade of a submission with the same sources, under this student's name.

        A damaged entry counts as missing.
        """
        path = self._path(submission, exercise, seed)
        if not path.exists():
            return None
        try:
            record = json.loads(path.read_text(encoding="utf-8"))
            grade, effort = Grade.from_json(record["grade"]), _EFFORTS.validate_python(record["effort"])
        except (*UNREADABLE, KeyError, TypeError):
            return None
        if grade.status != "graded" or grade.exercise != exercise.name:
            return None
        return CachedGrade(dataclasses.replace(grade, student=submission.student), effort)

    def put(self, submission: Submission, exercise: Exercise, seed: int, known: CachedGrade) -> None:
        """Cache a grade."""
        if known.grade.status != "graded":
            return
        path = self._path(submission, exercise, seed)
        record = {"grade": known.grade.to_json(), "effort": dataclasses.asdict(known.effort)}
        write_atomically(path, json.dumps(record))

    def _path(self, submission: Submission, exercise: Exercise, seed: int) -> Path:
        key = grade_key(submission, exercise, seed, self._isolation, "with effort")
        return self._folder / exercise.name / f"{key}.json"
