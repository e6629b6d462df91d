"""A cache of grades, with which an interrupted batch is resumed."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from functools import lru_cache
from pathlib import Path

from autograder.engine.exercise import Exercise
from autograder.engine.submission import Submission
from autograder.engine.verdict import Grade
from autograder.isolation.availability import Isolation
from ros_runtime.project import PROJECT

# What a verdict depends on besides the submission: the checks and the engine, the robot, the clock.
JUDGING = ("autograder", "robot_sim", "ros_runtime", "humanoid_interfaces")
WITHOUT_INFLUENCE = (
    "batch",
    "nbgrader_bridge",
    "report",
    "audit",
    "new_exercise",
)  # folders of autograder/


class GradeCache:
    """Grades on disk, keyed by what they depend on: sources, checks, seed of the scenario inputs, isolation.

    A submission that could not be graded is never cached.
    """

    def __init__(self, folder: Path, seed: int, isolation: Isolation) -> None:
        self._folder = folder
        self._seed = seed
        self._isolation = isolation

    def get(self, submission: Submission, exercise: Exercise) -> Grade | None:
        """Return the cached grade of a submission with the same sources, under this student's name."""
        path = self._path(submission, exercise)
        if not path.exists():
            return None
        return dataclasses.replace(Grade.from_json(json.loads(path.read_text())), student=submission.student)

    def put(self, submission: Submission, exercise: Exercise, grade: Grade) -> None:
        """Cache a grade."""
        if grade.status != "graded":
            return
        path = self._path(submission, exercise)
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_suffix(f".{submission.student}")  # an interruption must not leave half a grade
        unfinished.write_text(json.dumps(grade.to_json()))
        unfinished.replace(path)

    def _path(self, submission: Submission, exercise: Exercise) -> Path:
        key = hashlib.sha256(
            json.dumps(
                [
                    dict(submission.sources),
                    checks_version(exercise.folder),
                    [check.id for check in exercise.checks],
                    self._seed,
                    self._isolation.label,
                ]
            ).encode()
        )
        return self._folder / exercise.name / f"{key.hexdigest()}.json"


@lru_cache
def checks_version(exercise: Path) -> str:
    """Return a hash of every file that a verdict on the exercise in this folder depends on."""
    digest = hashlib.sha256()
    for path in sorted(exercise.glob("*.py")):
        digest.update(f"{path.name}\0".encode() + path.read_bytes())
    for room in JUDGING:
        for path in sorted((PROJECT / room).rglob("*")):
            place = path.relative_to(PROJECT)
            if path.is_file() and "__pycache__" not in place.parts and _has_influence(place):
                digest.update(f"{place}\0".encode() + path.read_bytes())
    return digest.hexdigest()


def _has_influence(place: Path) -> bool:
    return not (place.parts[0] == "autograder" and place.parts[1] in WITHOUT_INFLUENCE)
