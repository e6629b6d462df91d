"""A class server as in the documentation: an exercise is released and collected by nbgrader's exchange, and graded."""

from __future__ import annotations

import json
from pathlib import Path

import nbformat
import pytest
from course_command import COURSE
from page import Step, carry_out, steps

from ros_runtime.project import PROJECT

EXCHANGE = "/srv/nbgrader/exchange"
CORRECT = PROJECT / "solutions/patterns/known/correct"


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """The files of the instructor's clone that the page's commands use, and a folder for a student."""
    (tmp_path / "course").symlink_to(COURSE)
    (tmp_path / ".venv").symlink_to(PROJECT / ".venv")
    (tmp_path / "exercises").symlink_to(PROJECT / "exercises")
    (tmp_path / "student").mkdir()
    return tmp_path


def test_an_exercise_goes_out_and_comes_back_as_the_page_says(clone: Path) -> None:
    here = str(clone / "exchange")
    for step in steps(PROJECT / "docs/jupyterhub.md"):
        if not step.where and step.language != "sh":
            continue
        carry_out(Step(*(part.replace(EXCHANGE, here) for part in step)), clone, Path())
        if "fetch_assignment" in step.text:
            work_on(clone / "student/patterns/patterns.ipynb")

    (grade,) = json.loads((clone / "graded/grades.json").read_text())
    assert grade["exercise"] == "patterns"
    assert grade["status"] == "graded"
    visible = [check for check in grade["checks"] if not check["id"].startswith("hidden")]
    assert grade["score"] == grade["max_score"]
    assert len(visible) >= 7
    assert (clone / "graded/gradebook.db").exists()
    (feedback,) = (clone / "student/patterns/feedback").glob("*/patterns.html")
    assert (
        feedback.read_text()
        == (clone / f"graded/feedback/{grade['student']}/patterns/patterns.html").read_text()
    )


def work_on(notebook: Path) -> None:
    """Write a correct program into the cell for it."""
    program = sorted(CORRECT.glob("*.py"))[0].read_text()
    content = nbformat.read(notebook, as_version=4)
    next(
        cell for cell in content.cells if cell.id == "solution"
    ).source = f"%%writefile patterns.py\n{program}"
    nbformat.write(content, notebook)
