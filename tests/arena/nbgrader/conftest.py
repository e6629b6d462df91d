"""A course folder of nbgrader, empty."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from made_up_grades import SOLUTIONS

from autograder.classroom.nbgrader_bridge.course_folder import open_course
from autograder.classroom.nbgrader_bridge.gradebook import CourseGradebook


@pytest.fixture(scope="session")
def empty_database(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An empty gradebook, made once because nbgrader takes seconds to make one."""
    folder = tmp_path_factory.mktemp("empty")
    open_course(folder).gradebook.close()
    return folder / "gradebook.db"


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """The folder of a course without grades."""
    return tmp_path / "graded"


@pytest.fixture
def gradebook(course: Path, empty_database: Path) -> CourseGradebook:
    """Its gradebook."""
    course.mkdir()
    shutil.copyfile(empty_database, course / empty_database.name)
    return CourseGradebook(course, SOLUTIONS)
