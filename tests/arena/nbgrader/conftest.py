from __future__ import annotations

import dataclasses
import shutil
from pathlib import Path

import pytest

from autograder.engine.exercise import load_exercise
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.nbgrader_bridge.course_folder import open_course
from autograder.nbgrader_bridge.gradebook import CourseGradebook

ROOT = Path(__file__).resolve().parents[3]
SOLUTIONS = ROOT / "solutions"


def grade_of(
    student: str, exercise: str = "battery_service", *, hidden: bool = True, **verdicts: dict
) -> Grade:
    """A grade in which every check passed, except as the keyword arguments say: check id → fields of its verdict."""
    checks = [
        dataclasses.replace(
            CheckVerdict(
                check.id,
                check.title,
                "passed",
                check.points,
                check.points,
                hidden=check.hidden,
                robot_time=1.5,
            ),
            **verdicts.get(check.id, {}),
        )
        for check in load_exercise(exercise, hidden=hidden).checks
    ]
    assert set(verdicts) <= {check.id for check in checks}
    return Grade(exercise, student, "namespaces" if hidden else "untrusted", checks)


FAILED = {
    "status": "failed",
    "points": 0,
    "expected": "what should be",
    "observed": "what was",
    "help": "what to do",
}


@pytest.fixture(scope="session")
def empty_database(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A gradebook without anything in it; making one takes nbgrader seconds."""
    folder = tmp_path_factory.mktemp("empty")
    open_course(folder).gradebook.close()
    return folder / "gradebook.db"


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """The folder of a course that has no grades yet."""
    return tmp_path / "graded"


@pytest.fixture
def gradebook(course: Path, empty_database: Path) -> CourseGradebook:
    """Its gradebook."""
    course.mkdir()
    shutil.copyfile(empty_database, course / empty_database.name)
    return CourseGradebook(course, SOLUTIONS)
