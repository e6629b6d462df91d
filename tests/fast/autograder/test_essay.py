"""An essay is marked by a person: it has no checks, and before that no points, not even zero."""

from __future__ import annotations

import json
from pathlib import Path
from types import ModuleType

import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from rich.console import Console
from typer.testing import CliRunner

from autograder.authoring.rubric import Criterion, criteria_in
from autograder.classroom.batch.cache import GradeCache
from autograder.classroom.batch.collection import collect
from autograder.classroom.batch.job import BatchWatcher
from autograder.classroom.batch.runner import BatchRunner
from autograder.classroom.nbgrader_bridge.generated_cells import with_criterion_cells
from autograder.engine.essay import load_essay, unmarked_grade
from autograder.engine.exercise import (
    UnknownExercise,
    UnusableExercise,
    all_names,
    essay_names,
    exercise_names,
    load_exercise,
)
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import Isolation
from autograder.report.table import class_table, progress_line
from course_cli.app import app

NAME = "arm_architecture"
ESSAY = load_essay(NAME)
WORK = "a -> b : wire 24 V\n"


def hand_in(folder: Path, text: str) -> Path:
    path = folder / "anna" / NAME / f"{NAME}.ipynb"
    path.parent.mkdir(parents=True)
    path.write_text(text)
    return path


def notebook(work: str) -> str:
    return json.dumps(new_notebook(cells=[new_code_cell(f"%%writefile {NAME}.txt\n{work}")]))


def run_batch(folder: Path, reported: list[CheckVerdict]):
    isolation = Isolation(Kind.NAMESPACES, "as a test says")
    cache = GradeCache(folder / "cache", isolation)
    runner = BatchRunner(cache, isolation, jobs=1, watcher=BatchWatcher(reported.append))
    (graded,) = runner.run(collect(folder / "submitted").works)
    assert len(reported) == runner.count(NAME)
    return graded


def printed(renderable: object) -> str:
    console = Console(width=160, record=True, file=open("/dev/null", "w"))  # noqa: SIM115
    console.print(renderable)
    return console.export_text()


def test_exercises_with_checks_and_essays_are_distinguished() -> None:
    assert NAME in essay_names()
    assert NAME not in exercise_names()
    assert sorted(exercise_names() + essay_names()) == all_names()


def test_an_essay_has_no_checks() -> None:
    with pytest.raises(UnknownExercise, match="a person marks it"):
        load_exercise(NAME, hidden=True)


def test_work_is_read_and_waits_without_points(tmp_path: Path) -> None:
    hand_in(tmp_path / "submitted", notebook(WORK))
    graded = run_batch(tmp_path, [])
    assert graded.sources == {f"{NAME}.txt": WORK}
    assert (graded.grade.status, graded.grade.score) == ("to mark", None)
    assert {verdict.status for verdict in graded.grade.checks} == {"to mark"}
    assert graded.grade.max_score == sum(criterion.points for criterion in ESSAY.criteria) == 20


@pytest.mark.parametrize("text", ["not a notebook", json.dumps(new_notebook())])
def test_unreadable_work_also_waits_for_a_person(tmp_path: Path, text: str) -> None:
    hand_in(tmp_path / "submitted", text)
    graded = run_batch(tmp_path, [])
    assert graded.sources is None
    assert "notebook" in graded.problem or "cell" in graded.problem
    assert (graded.grade.status, graded.grade.score) == ("to mark", None)


def test_a_record_is_read_back_as_it_was_written() -> None:
    grade = unmarked_grade(ESSAY, "anna")
    assert grade.to_json()["score"] is None
    assert Grade.from_json(json.loads(json.dumps(grade.to_json()))) == grade


def test_one_criterion_without_points_leaves_the_essay_ungraded() -> None:
    verdicts = [CheckVerdict("a", "A", "marked", 2, 2), CheckVerdict("b", "B", "to mark", 0, 3)]
    assert Grade(NAME, "anna", "by hand", verdicts).score is None


def test_the_table_of_a_class_says_what_waits_and_where_points_were_lost() -> None:
    waiting = unmarked_grade(ESSAY, "anna")
    verdicts = [CheckVerdict("graph", "G", "marked", 2, 2), CheckVerdict("safety", "S", "marked", 1.5, 3)]
    marked = Grade(NAME, "bert", "by hand", verdicts)
    table = printed(class_table([waiting, marked]))
    assert "to be marked by hand: 7 of 7 criteria" in table
    assert "0/20" not in table
    assert "3.5/5" in table
    assert "safety (1.5/3)" in table
    assert "graph" not in table
    assert "to be marked by hand" in printed(progress_line(waiting))


def test_checking_an_essay_prints_its_criteria(tmp_path: Path) -> None:
    path = hand_in(tmp_path, notebook(WORK))
    ran = CliRunner().invoke(app("check"), ["check", NAME, str(path)])
    assert ran.exit_code == 0, ran.output
    assert "A person marks arm_architecture" in " ".join(ran.output.split())
    assert "Safety: 3 points" in ran.output


def test_a_student_learns_that_an_essay_cannot_be_read(tmp_path: Path) -> None:
    ran = CliRunner().invoke(app("check"), ["check", NAME, str(hand_in(tmp_path, "no notebook"))])
    assert ran.exit_code == 2
    assert "is not a notebook" in " ".join(ran.output.split())


def test_a_notebook_without_a_place_for_the_rubric_is_named() -> None:
    with pytest.raises(UnusableExercise, match="has no cell 'rubric'"):
        with_criterion_cells(new_notebook(cells=[new_markdown_cell("# An essay", id="title")]), ESSAY)


@pytest.mark.parametrize(
    ("criteria", "problem"),
    [
        ((), "it has no CRITERIA"),
        ((Criterion("a", "A", {1: "x"}), Criterion("a", "B", {1: "x"})), "two criteria are called 'a'"),
        ((Criterion("a", "A", {0: "x"}),), "can earn no points"),
        ((Criterion("a", "A", {}),), "can earn no points"),
    ],
)
def test_a_rubric_that_gives_nothing_is_named(criteria: tuple[Criterion, ...], problem: str) -> None:
    module = ModuleType("rubric")
    module.CRITERIA = criteria  # type: ignore[attr-defined]
    with pytest.raises(ValueError, match=problem):
        criteria_in(module)
