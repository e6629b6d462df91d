"""The questions about a student's program as an assignment of nbgrader, marked by a person in formgrader."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import nbformat
import pytest
from nbgrader.api import Gradebook
from nbgrader.utils import is_grade, is_solution
from typer.testing import CliRunner

from autograder.classroom.commands import questions as command
from autograder.classroom.nbgrader_bridge.class_export import ClassExport
from autograder.classroom.questions.formgrader import POINTS, enter_questions, write_notebook
from autograder.classroom.questions.question import Part, Question, Sheet
from course_cli.app import app

NAME = "walk_to_questions"
CELLS = ("question_1", "question_2")
TWO = (
    Part("Which line noticed it?", "line 2, `a < b`, 0.03 s later."),
    Part("Why not earlier?", "It waits."),
)
ANNA = Sheet(
    "anna", "walk_to", "import rclpy\na < b\n```\n", (Question("moment", 2, "A client cancelled.", TWO),) * 2
)
BEN = Sheet("ben", "walk_to", note="no questions: the program passes no check")


@pytest.fixture
def submitted(tmp_path):
    return tmp_path / "submitted"


@pytest.fixture
def course(course, empty_database):
    course.mkdir()
    shutil.copyfile(empty_database, course / empty_database.name)
    return course


def enter(course, submitted, *sheets):
    return enter_questions(course, sheets, submitted, len(CELLS))


def hand_in(submitted: Path, answer: str) -> None:
    """Answer the first question in the student's notebook, and hand it in as nbgrader's collect does."""
    write_notebook(submitted.parent / "students", ANNA)
    notebook = nbformat.read(submitted.parent / "students" / "anna" / f"{NAME}.ipynb", as_version=4)
    (cell,) = [cell for cell in notebook.cells if cell.id == CELLS[0]]
    cell.source = answer
    place = submitted / "anna" / NAME / f"{NAME}.ipynb"
    place.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, place)


def mark(course, student, points):
    """Enter points as formgrader does."""
    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        for name in CELLS:
            grade = db.find_grade(name, NAME, NAME, student)
            grade.manual_score, grade.needs_manual_grade = points, False
        db.db.commit()


def scores(course, student):
    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        notebook = db.find_submission_notebook(NAME, NAME, student)
        return notebook.score, notebook.max_score, notebook.needs_manual_grade


def shown(course, student):
    """The cells that formgrader shows."""
    return nbformat.read(course / "autograded" / student / NAME / f"{NAME}.ipynb", as_version=4).cells


def nbgrader(course, *words):
    """Run a command of nbgrader in the course's folder, as an instructor does."""
    subprocess.run([sys.executable, "-m", "nbgrader", *words, "--force"], cwd=course, check=True)


def test_everybody_waits_for_a_person_below_their_own_questions_with_keys(course, submitted):
    assert enter(course, submitted, ANNA, BEN) == 0
    for sheet in (ANNA, BEN):
        assert scores(course, sheet.student) == (0, POINTS * len(CELLS), True)
        cells = [cell for cell in shown(course, sheet.student) if is_grade(cell) and is_solution(cell)]
        assert [cell.metadata.nbgrader.grade_id for cell in cells] == list(CELLS)
        assert all("No written answer." in cell.source for cell in cells)
    annas, bens = ("\n".join(cell.source for cell in shown(course, name)) for name in ("anna", "ben"))
    assert "<p>(a) line 2, <code>a &lt; b</code>, 0.03 s later.</p>" in annas
    assert "   2  a < b" in annas
    assert "Ask one of your own." in bens
    assert BEN.note in bens


def test_students_notebook_and_release_have_no_key(course, submitted):
    enter(course, submitted, ANNA)
    hand_in(submitted, "It polls.")
    release = (course / "release" / NAME / f"{NAME}.ipynb").read_text()
    assert CELLS[0] in release
    for text in (release, (submitted.parent / "students" / "anna" / f"{NAME}.ipynb").read_text()):
        assert "YOUR ANSWER HERE" in text
        assert "0.03 s" not in text
        assert "examiner" not in text


def test_a_written_answer_is_text_and_points_for_an_earlier_one_wait_again(course, submitted):
    enter(course, submitted, ANNA)
    mark(course, "anna", 1.5)
    assert enter(course, submitted, ANNA) == 1
    attack = "```\n<script>alert('owned')</script> \x1b"
    hand_in(submitted, attack)
    assert enter(course, submitted, ANNA) == 0
    (cell,) = [cell for cell in shown(course, "anna") if cell.id == CELLS[0]]
    assert f"````text\n{attack[:-1]}\N{REPLACEMENT CHARACTER}\n````" in cell.source
    assert scores(course, "anna") == (3.0, 4.0, True)


def test_an_unreadable_answer_is_named(course, submitted):
    hand_in(submitted, "It polls.")
    (submitted / "anna" / NAME / f"{NAME}.ipynb").write_text("[1, 2")
    enter(course, submitted, ANNA)
    assert any(
        "The answers cannot be read: is not a notebook" in cell.source for cell in shown(course, "anna")
    )


def test_command_enters_the_questions_and_says_why_their_number_cannot_change(
    course, submitted, tmp_path, monkeypatch
):
    (submitted / "anna").mkdir(parents=True)
    (submitted / "anna" / "walk_to.py").write_text(ANNA.program)
    monkeypatch.setattr(command.Maker, "sheet", lambda maker: ANNA)
    words = [
        "questions",
        "walk_to",
        str(submitted),
        "--out",
        str(tmp_path / "out"),
        "--nbgrader",
        str(course),
    ]
    done = CliRunner().invoke(app("questions"), [*words, "--number", "2"])
    assert done.exit_code == 0, done.output
    assert "0 of 1 students are marked" in done.output
    assert scores(course, "anna") == (0, POINTS * 2, True)
    more = CliRunner().invoke(app("questions"), [*words, "--number", "3"])
    assert more.exit_code == 1
    assert "give another folder" in " ".join(more.output.split())


def test_marked_questions_are_exported(course, submitted, tmp_path):
    enter(course, submitted, ANNA, BEN)
    mark(course, "anna", 1.5)
    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        ClassExport(to=str(tmp_path / "grades.csv")).export(db)
    assert (tmp_path / "grades.csv").read_text().splitlines()[1:] == ["anna,walk_to_questions,3,4,0,0"]


def test_nbgraders_commands_keep_the_points_and_give_back_a_page_without_keys(course, submitted):
    hand_in(submitted, "It polls.")
    enter(course, submitted, ANNA)
    mark(course, "anna", 1.5)
    nbgrader(course, "autograde", NAME)
    nbgrader(course, "generate_feedback", NAME)
    assert scores(course, "anna") == (
        3.0,
        4.0,
        True,
    )  # nbgrader has a person confirm points of autograded answers
    page = (course / "feedback" / "anna" / NAME / f"{NAME}.html").read_text()
    assert "3.0 / 4.0" in page
    assert "It polls." in page
    assert "0.03 s" not in page
