"""Whatever a student's notebook contains, it costs no other student a grade, and the grader never executes it."""

from __future__ import annotations

import copy
import json

import nbformat
import pytest
from made_up_grades import ROOT, grade_of
from nbformat.v4 import new_code_cell, new_markdown_cell, new_output
from nbgrader.api import Gradebook
from nbgrader.utils import is_grade, is_solution

from autograder.classroom.batch.collection import collect
from autograder.classroom.nbgrader_bridge.gradebook import Entry
from autograder.engine.submission import UnusableSubmission

MOST_BYTES = 2_000_000  # of a page, whatever was handed in
ATTACK = "<img src=x onerror=alert('owned')>"
RELEASE = nbformat.read(ROOT / "exercises/battery_service/battery_service.ipynb", as_version=4)


def solution_of(notebook):
    return next(cell for cell in notebook.cells if is_solution(cell))


def duplicated_solution(notebook):
    twin = copy.deepcopy(solution_of(notebook))
    twin.source = "%%writefile battery_service.py\nprint('the last one counts')\n"
    twin.id = "twin"
    notebook.cells.append(twin)


def unknown_schema(notebook):
    for cell in notebook.cells:
        if "nbgrader" in cell.metadata:
            cell.metadata.nbgrader.schema_version = 99


def attack_in_markdown(notebook):
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            cell.source = ATTACK
    notebook.cells.insert(0, new_markdown_cell(ATTACK))


def enormous_output(notebook):
    solution_of(notebook).outputs = [new_output("stream", name="stdout", text="x" * 5_000_000)]


def missing_grade_cells(notebook):
    notebook.cells = [cell for cell in notebook.cells if not is_grade(cell)]


def rewritten_grade_cells(notebook):
    for cell in notebook.cells:
        if is_grade(cell):
            cell.source = "100.0"
            cell.metadata.nbgrader.points = 100
            cell.outputs = [new_output("execute_result", data={"text/plain": "100.0"})]


def foreign_grade_cell(notebook):
    cell = new_code_cell("5", metadata=copy.deepcopy(notebook.cells[-1].metadata))
    cell.metadata.nbgrader.grade_id = "no_such_check"
    notebook.cells.append(cell)


def other_kernel(notebook):
    notebook.metadata.kernelspec = {"name": "bash", "display_name": "Bash", "language": "bash"}


def enormous_source(notebook):
    solution_of(notebook).source = "%%writefile battery_service.py\n" + "x = 1\n" * 100_000


def escapes_in_source(notebook):
    solution_of(notebook).source = f"%%writefile battery_service.py\n# \x1b[31m\x07 {ATTACK} </code></pre>\n"


def runs_something(notebook):
    for cell in notebook.cells:
        if cell.cell_type == "code" and not is_solution(cell):
            cell.source = "open('ran_in_the_grader', 'w').close()"


def of_the_third_format(notebook):
    old = nbformat.convert(copy.deepcopy(notebook), 3)
    notebook.clear()
    notebook.update(old)


def one_id_for_all(notebook):
    for cell in notebook.cells:
        cell.id = "same"


def in_two_cells(notebook):
    first, second = (
        "%%writefile battery_service.py\nimport rclpy\n",
        "%%writefile -a battery_service.py\nx = 1\n",
    )
    solution_of(notebook).source = first
    notebook.cells.append(new_code_cell(second))


HOSTILE = [
    duplicated_solution,
    unknown_schema,
    attack_in_markdown,
    enormous_output,
    missing_grade_cells,
    rewritten_grade_cells,
    foreign_grade_cell,
    other_kernel,
    enormous_source,
    escapes_in_source,
    runs_something,
    of_the_third_format,
    one_id_for_all,
    in_two_cells,
]


def handed_in(folder, student, content):
    path = folder / student / "battery_service/battery_service.ipynb"
    path.parent.mkdir(parents=True)
    path.write_text(content)


def test_hostile_notebooks_are_entered_beside_all_others(gradebook, course, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    submitted = tmp_path / "submitted"
    for hostile in HOSTILE:
        notebook = copy.deepcopy(RELEASE)
        hostile(notebook)
        handed_in(submitted, hostile.__name__, json.dumps(notebook))
    handed_in(submitted, "zoe", json.dumps(RELEASE))
    works = collect(submitted).works
    assert len(works) == len(HOSTILE) + 1

    for work in works:
        sources = work.read().sources
        assert gradebook.enter(Entry(grade_of(work.student), sources)).exists(), work.student

    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        entered = {
            submission.student.id: submission for submission in db.assignment_submissions("battery_service")
        }
        full = grade_of("zoe").max_score
        assert {student: entry.score for student, entry in entered.items()} == {
            work.student: full for work in works
        }
        assert {entry.max_score for entry in entered.values()} == {full}
    written = [
        path for room in ("submitted", "autograded", "feedback") for path in (course / room).rglob("*.*")
    ]
    assert len(written) == 3 * len(works)
    for path in written:
        if path.suffix == ".html":
            assert ATTACK not in path.read_text(), path
        assert path.stat().st_size < MOST_BYTES, path
    assert not list(tmp_path.rglob("ran_in_the_grader"))


def test_of_two_solution_cells_the_one_that_was_graded_is_shown(gradebook, tmp_path):
    notebook = copy.deepcopy(RELEASE)
    duplicated_solution(notebook)
    handed_in(tmp_path / "submitted", "anna", json.dumps(notebook))
    (work,) = collect(tmp_path / "submitted").works
    sources = work.read().sources
    assert sources == {"battery_service.py": "print('the last one counts')\n"}
    assert "the last one counts" in gradebook.enter(Entry(grade_of("anna"), sources)).read_text()


@pytest.mark.parametrize(
    "content",
    [
        "not JSON at all",
        "{}",
        '{"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": [7]}',
        json.dumps({**RELEASE, "cells": [cell for cell in RELEASE.cells if not is_solution(cell)]}),
        json.dumps(
            {
                **RELEASE,
                "cells": [{**solution_of(RELEASE), "source": "%%writefile battery_service.py\n\ud800"}],
            }
        ),
    ],
    ids=["no JSON", "empty", "cells of numbers", "no solution cell", "half a character"],
)
def test_an_unreadable_notebook_is_reported_to_the_student(gradebook, tmp_path, content):
    handed_in(tmp_path / "submitted", "anna", content)
    (work,) = collect(tmp_path / "submitted").works
    with pytest.raises(UnusableSubmission) as problem:
        work.read()
    assert str(tmp_path) not in str(problem.value)
    page = gradebook.enter(Entry(grade_of("anna"), None, str(problem.value)))
    assert "The submission could not be read" in page.read_text()
