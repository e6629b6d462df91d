"""An essay in nbgrader's gradebook: it waits for a person, and a person's points are never lost."""

from __future__ import annotations

import csv
import re

import nbformat
import pytest
from made_up_grades import SOLUTIONS, grade_of
from nbgrader.api import Gradebook

from autograder.classroom.nbgrader_bridge.class_export import ClassExport
from autograder.classroom.nbgrader_bridge.course_folder import call, open_course
from autograder.classroom.nbgrader_bridge.gradebook import CourseGradebook, Entry
from autograder.engine.essay import load_essay, unmarked_grade

NAME = "arm_architecture"
ESSAY = load_essay(NAME)
WORK = {f"{NAME}.txt": "button -> relay : wire 24 V\n    rate: constant\n"}
FULL_MARKS = {criterion.id: float(criterion.points) for criterion in ESSAY.criteria}


def essay_of(student, sources=WORK, problem=""):
    return Entry(unmarked_grade(ESSAY, student), sources, problem)


def database(course):
    return Gradebook(f"sqlite:///{course / 'gradebook.db'}")


def mark(course, student, points, comment="well argued"):
    """Enter points as formgrader does."""
    with database(course) as db:
        for criterion, score in points.items():
            grade = db.find_grade(criterion, NAME, NAME, student)
            grade.manual_score, grade.needs_manual_grade = score, False
        db.find_comment("safety", NAME, NAME, student).manual_comment = comment
        db.db.commit()


def scores(course, student):
    with database(course) as db:
        notebook = db.find_submission_notebook(NAME, NAME, student)
        return notebook.score, notebook.max_score, notebook.needs_manual_grade


@pytest.mark.parametrize(
    "entry",
    [
        essay_of("anna"),
        essay_of("anna", {f"{NAME}.txt": ""}),
        essay_of("anna", None, "it is not a notebook"),
    ],
    ids=["work", "nothing written", "unreadable"],
)
def test_it_waits_for_a_person_and_has_no_page_yet(gradebook, course, entry):
    assert gradebook.enter(entry) is None
    with database(course) as db:
        grades = db.find_submission_notebook(NAME, NAME, "anna").grades
        assert {grade.name for grade in grades} == set(FULL_MARKS)
        assert all(grade.needs_manual_grade for grade in grades)
        assert all(grade.auto_score is None and grade.manual_score is None for grade in grades)
    assert gradebook.as_marked(entry.grade).score is None
    assert not (course / "feedback/anna").exists()


def test_some_points_are_not_yet_a_grade(gradebook, course):
    gradebook.enter(essay_of("anna"))
    mark(course, "anna", {"graph": 2.0})
    assert gradebook.enter(essay_of("anna")) is None
    marked = gradebook.as_marked(essay_of("anna").grade)
    assert (marked.status, marked.score) == ("to mark", None)
    assert marked.checks[0].points == 2


def test_when_every_criterion_has_points_the_next_run_makes_grade_and_page(gradebook, course):
    gradebook.enter(essay_of("anna"))
    mark(course, "anna", FULL_MARKS | {"safety": 1.5})
    page = gradebook.enter(essay_of("anna"))
    marked = gradebook.as_marked(essay_of("anna").grade)
    assert (marked.status, marked.score, marked.max_score) == ("graded", 18.5, 20)
    assert scores(course, "anna") == (18.5, 20, False)
    text = page.read_text()
    assert "18.5 / 20.0" in text
    assert "well argued" in text
    assert "wire 24 V" in re.sub("<[^>]+>", "", text)  # coloured, so in pieces
    assert "Your marker saw a drawing of this." in text


def test_autograding_again_from_formgrader_leaves_the_points_alone(gradebook, course):
    gradebook.enter(essay_of("anna"))
    mark(course, "anna", FULL_MARKS)
    call(open_course(course).autograde, NAME, "anna")
    assert scores(course, "anna") == (20, 20, False)


def test_points_for_earlier_work_wait_for_a_second_look(gradebook, course):
    gradebook.enter(essay_of("anna"))
    mark(course, "anna", FULL_MARKS)
    assert gradebook.enter(essay_of("anna")) is not None
    other = essay_of("anna", {f"{NAME}.txt": "something else\n"})
    assert gradebook.enter(other) is None
    assert gradebook.as_marked(other.grade).status == "to mark"
    assert not (course / f"feedback/anna/{NAME}/{NAME}.html").exists()
    with database(course) as db:
        assert db.find_grade("safety", NAME, NAME, "anna").manual_score == FULL_MARKS["safety"]


def test_a_gradebook_that_was_lost_is_made_again_and_waits(gradebook, course):
    gradebook.enter(essay_of("anna"))
    mark(course, "anna", FULL_MARKS)
    (course / "gradebook.db").unlink()
    again = CourseGradebook(course, SOLUTIONS)
    assert again.enter(essay_of("anna")) is None
    assert scores(course, "anna")[2]


def test_the_marker_sees_the_work_and_its_drawing_and_no_live_html(gradebook, course):
    attack = "<script>alert('owned')</script>"
    gradebook.enter(essay_of("anna", {f"{NAME}.txt": f"a -> b : topic {attack}\n"}))
    notebook = nbformat.read(course / f"autograded/anna/{NAME}/{NAME}.ipynb", as_version=4)
    (cell,) = [cell for cell in notebook.cells if cell.cell_type == "code" and attack in cell.source]
    (drawing,) = cell.outputs
    assert "a -&gt; b: topic" in drawing.data["image/svg+xml"]
    assert attack not in drawing.data["image/svg+xml"]


def test_an_export_leaves_out_what_is_not_marked_yet(gradebook, course, tmp_path):
    gradebook.enter(essay_of("anna"))
    gradebook.enter(essay_of("bert"))
    gradebook.enter(Entry(grade_of("anna"), {"battery_service.py": "print()\n"}))
    mark(course, "bert", FULL_MARKS | {"graph": 1.0})
    with database(course) as db:
        ClassExport(to=str(tmp_path / "grades.csv")).export(db)
    with (tmp_path / "grades.csv").open() as file:
        rows = {(row["assignment"], row["student_id"]): row["score"] for row in csv.DictReader(file)}
    assert (NAME, "anna") not in rows
    assert rows[NAME, "bert"] == "19"
    assert float(rows["battery_service", "anna"]) == grade_of("anna").score
