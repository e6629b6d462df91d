"""Grading one student or one exercise does not change the grades of the others."""

from __future__ import annotations

import pytest

from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.records import read_grades, write_grades
from autograder.classroom.batch.seeds import Seeds
from autograder.classroom.batch.selection import require_seed, select, with_others
from autograder.engine.verdict import CheckVerdict, Grade
from ros_runtime.course_error import CourseError

WORKS = [Work(student, exercise) for student in ("anna", "bert") for exercise in ("patterns", "walk_to")]


def grade(student: str, exercise: str, points: float = 1, seed: int = 0) -> Grade:
    return Grade(
        exercise, student, "namespaces", [CheckVerdict("id", "title", "passed", points, 2)], seed=seed
    )


@pytest.mark.parametrize(
    ("students", "exercises", "expected"),
    [
        ([], [], [0, 1, 2, 3]),
        (["bert"], [], [2, 3]),
        ([], ["walk_to"], [1, 3]),
        (["anna", "bert"], ["patterns"], [0, 2]),
    ],
)
def test_names_select_students_and_exercises(students, exercises, expected):
    assert select(WORKS, students, exercises) == [WORKS[number] for number in expected]


def test_a_name_without_a_submission_is_reported_with_the_known_names():
    with pytest.raises(CourseError, match=r"--student carl: .*anna, bert"):
        select(WORKS, ["carl"], [])
    with pytest.raises(CourseError, match=r"--exercise walk: .*patterns, walk_to"):
        select(WORKS, [], ["walk"])
    with pytest.raises(CourseError, match="anna handed in none of patterns"):
        select(WORKS[1:3], ["anna"], ["patterns"])


def test_the_selected_row_is_replaced_and_the_others_stay(tmp_path):
    before = [grade("anna", "patterns"), grade("bert", "patterns"), grade("bert", "walk_to")]
    write_grades(tmp_path / "grades.json", before)
    again = grade("bert", "patterns", points=2)
    assert with_others([again], read_grades(tmp_path / "grades.json")) == [before[0], again, before[2]]
    assert read_grades(tmp_path / "none.json") == []


def test_grades_of_different_seeds_are_not_mixed():
    require_seed([grade("anna", "patterns", seed=3)], Seeds(3))
    with pytest.raises(CourseError, match=r"with seed 3, .* seed 0;"):
        require_seed([grade("anna", "patterns", seed=3)], Seeds(0))


def test_each_student_has_a_seed_that_depends_on_nothing_but_the_batch_and_the_name():
    seeds = Seeds(5, per_student=True)
    assert len({seeds.of(student, {}) for student in ("anna", "bert", "carl")}) == 3
    assert seeds.of("anna", {}) == seeds.of("anna", {"walk_to.py": "x"})
    assert seeds.of("anna", {}) != Seeds(6, per_student=True).of("anna", {})
    assert Seeds(5).of("anna", {}) == Seeds(5).of("bert", {"walk_to.py": "x"}) == 5
    require_seed([grade("anna", "patterns", seed=seeds.of("anna", {}))], seeds)
