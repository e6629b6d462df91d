"""solutions/, exercises/ and the checks are consistent."""

from __future__ import annotations

import ast
import shutil
from pathlib import Path

import nbformat
import pytest
from nbgrader.nbgraderformat import MetadataValidator
from nbgrader.utils import is_grade, is_solution, is_task

from autograder.classroom.archives.student_bundle import require_no_leak, visible_checks
from autograder.classroom.nbgrader_bridge.release import (
    bring_up_to_date,
    generate_release,
    out_of_date,
    source_notebooks,
)
from autograder.engine.essay import load_essay
from autograder.engine.exercise import all_names, essay_names, exercise_names, file_names, load_exercise

ROOT = Path(__file__).resolve().parents[3]
SOLUTIONS = ROOT / "solutions"
EXERCISES = ROOT / "exercises"
FEW = ("arm_architecture", "battery_service")
RENEW = "run ./course release --exercises and commit what it changes"


def read(folder, exercise):
    return nbformat.read(folder / exercise / f"{exercise}.ipynb", as_version=4)


def test_every_exercise_has_a_source_notebook():
    assert sorted(source_notebooks(SOLUTIONS)) == all_names()


def test_exercises_are_what_nbgrader_makes_of_solutions():
    assert out_of_date(SOLUTIONS, EXERCISES) == [], RENEW


@pytest.mark.parametrize("folder", [SOLUTIONS, EXERCISES], ids=["solutions", "exercises"])
@pytest.mark.parametrize("exercise", exercise_names())
def test_grade_cells_are_the_checks_in_order_with_their_points(folder, exercise):
    cells = [cell for cell in read(folder, exercise).cells if is_grade(cell)]
    checks = load_exercise(exercise, hidden=True).checks
    visible = [check for check in checks if not check.hidden]
    hidden = [check for check in checks if check.hidden]
    expected = [(check.id, check.points) for check in visible]
    expected += [(f"hidden_{number}", check.points) for number, check in enumerate(hidden, start=1)]
    assert [(cell.metadata.nbgrader.grade_id, cell.metadata.nbgrader.points) for cell in cells] == expected
    assert all(cell.metadata.nbgrader.locked for cell in cells)


@pytest.mark.parametrize("folder", [SOLUTIONS, EXERCISES], ids=["solutions", "exercises"])
@pytest.mark.parametrize("essay", essay_names())
def test_an_essay_has_a_cell_for_each_criterion_which_only_a_person_can_fill(folder, essay):
    cells = [cell for cell in read(folder, essay).cells if is_grade(cell) or is_task(cell)]
    criteria = load_essay(essay).criteria
    assert [(cell.metadata.nbgrader.grade_id, cell.metadata.nbgrader.points) for cell in cells] == [
        (criterion.id, criterion.points) for criterion in criteria
    ]
    assert all(is_task(cell) and not is_grade(cell) and cell.metadata.nbgrader.locked for cell in cells)


@pytest.mark.parametrize("folder", [SOLUTIONS, EXERCISES], ids=["solutions", "exercises"])
@pytest.mark.parametrize("exercise", all_names())
def test_notebooks_are_valid_stripped_and_have_stable_cell_ids(folder, exercise):
    notebook = read(folder, exercise)
    nbformat.validate(notebook)
    MetadataValidator().validate_nb(notebook)
    assert (notebook.nbformat, notebook.nbformat_minor) == (4, 5)
    assert len({cell.id for cell in notebook.cells}) == len(notebook.cells)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert code
    assert all(cell.outputs == [] and cell.execution_count is None for cell in code)


@pytest.mark.parametrize("exercise", exercise_names())
def test_a_release_contains_no_solution_and_no_hidden_checks(exercise):
    release = (EXERCISES / exercise / f"{exercise}.ipynb").read_text()
    assert "BEGIN SOLUTION" not in release
    assert "END SOLUTION" not in release
    for check in load_exercise(exercise, hidden=True).checks:
        if check.hidden:
            assert check.id not in release
            assert check.title not in release


def test_no_module_with_visible_checks_names_a_hidden_one():
    require_no_leak(dict(visible_checks()))


@pytest.mark.parametrize("exercise", all_names())
def test_the_starter_lacks_the_solutions_of_the_reference(exercise):
    reference, starter = (solutions_in(folder, exercise) for folder in (SOLUTIONS, EXERCISES))
    assert list(reference) == list(starter) == list(file_names(exercise))
    for name, source in starter.items():
        assert "# YOUR CODE HERE" in source
        assert len(source) < 0.9 * len(reference[name])
        if name.endswith(".py"):
            ast.parse(source)
            ast.parse(reference[name])


def solutions_in(folder, exercise):
    """The source of each file that the notebook's solution cells write, by its name."""
    cells = [cell for cell in read(folder, exercise).cells if is_solution(cell)]
    written = (cell.source.partition("\n") for cell in cells)
    return {magic.removeprefix("%%writefile "): source for magic, _, source in written}


@pytest.fixture
def few(tmp_path):
    """Copies of solutions/ and exercises/ with one exercise and one essay."""
    for folder in (SOLUTIONS, EXERCISES):
        for exercise in FEW:
            shutil.copytree(folder / exercise, tmp_path / folder.name / exercise)
    return tmp_path / SOLUTIONS.name, tmp_path / EXERCISES.name


def test_outdated_files_are_named_and_renewed(few):
    solutions, exercises = few
    source = solutions / "battery_service/battery_service.ipynb"
    release = exercises / "battery_service/battery_service.ipynb"
    source.write_text(source.read_text().replace('"points": 2', '"points": 3'))
    leftover = exercises / "removed/removed.ipynb"
    leftover.parent.mkdir()
    shutil.copyfile(release, leftover)
    release.write_text(release.read_text().replace("relative name", "absolute name"))
    assert set(out_of_date(solutions, exercises)) == {source, release, leftover}
    assert set(bring_up_to_date(solutions, exercises)) == {source, release, leftover}
    assert out_of_date(solutions, exercises) == []
    assert source.read_text() == (SOLUTIONS / "battery_service/battery_service.ipynb").read_text()
    assert not leftover.exists()


def test_a_program_left_beside_a_source_notebook_is_not_released(few, tmp_path):
    solutions, _ = few
    (solutions / "battery_service/battery_service.py").write_text("the reference solution")
    generate_release(solutions, tmp_path / "made")
    written = [path.name for path in (tmp_path / "made").rglob("*") if path.is_file()]
    assert sorted(written) == [f"{exercise}.ipynb" for exercise in FEW]
