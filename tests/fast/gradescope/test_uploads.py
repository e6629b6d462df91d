"""results.json for uploads that never reach an arena, and for a container that cannot grade."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from autograder.classroom.export.gradescope import Results
from autograder.classroom.on_gradescope.container import Container
from autograder.classroom.on_gradescope.grading import grade_upload
from autograder.engine.exercise import load_exercise
from autograder.isolation.arena_spec import Kind
from autograder.isolation.availability import Isolation
from course_cli.app import app

SOMEHOW = Isolation(Kind.ANOTHER_USER, "no arena is started here")


@pytest.fixture
def container(tmp_path: Path) -> Container:
    (tmp_path / "submission").mkdir()
    return Container(tmp_path)


def graded(container: Container, exercise: str = "patterns") -> Results:
    return grade_upload(container, exercise, SOMEHOW)


def test_an_upload_without_the_file_gets_no_points_and_the_name_it_needs(container: Container) -> None:
    (container.submission / "solution.py").write_text("print()")
    results = graded(container)
    assert results.score == 0
    assert results.tests
    assert "neither patterns.ipynb nor patterns.py" in results.tests[0].output
    assert (
        sum(test.max_score for test in results.tests) == load_exercise("patterns", hidden=False).max_score()
    )


def test_a_link_is_not_followed(container: Container) -> None:
    secret = container.root / "secret.py"
    secret.write_text("the instructor's")
    (container.submission / "patterns.py").symlink_to(secret)
    results = graded(container)
    assert results.score == 0
    assert results.tests
    assert "is not an ordinary file" in results.tests[0].output


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ([], "found none"),
        (["notes.txt"], "found none"),
        (["patterns.py", "walk_to.py"], "found patterns, walk_to"),
    ],
)
def test_a_package_for_all_exercises_asks_for_the_file_of_one(
    container: Container, files: list[str], said: str
) -> None:
    for name in files:
        (container.submission / name).write_text("print()")
    results = graded(container, "")
    assert results.score == 0
    assert said in results.output


def test_a_container_that_cannot_grade_writes_no_score_and_removes_the_last_one(
    container: Container, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COURSE_ISOLATION", "none")
    container.results.parent.mkdir()
    container.results.write_text('{"score": 1000}')
    done = CliRunner().invoke(app("gradescope"), ["gradescope", "--root", str(container.root)])
    assert done.exit_code == 1
    assert "not graded: COURSE_ISOLATION=none" in done.output
    assert set(json.loads(container.results.read_text())) == {
        "output",
        "output_format",
        "visibility",
        "stdout_visibility",
    }
    assert {folder.stat().st_mode & 0o777 for folder in (container.submission, container.results.parent)} == {
        0o700
    }


def test_an_error_of_the_grader_gives_no_score(container: Container, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail() -> Isolation:
        raise RuntimeError("a broken image")

    monkeypatch.setattr("autograder.classroom.commands.gradescope.isolation_here", fail)
    done = CliRunner().invoke(app("gradescope"), ["gradescope", "--root", str(container.root)])
    assert done.exit_code == 1
    assert "score" not in json.loads(container.results.read_text())
