"""Writes the pages of a graded class: class.html and instructor/ for the instructor, pages/ for the students."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from urllib.parse import quote

from markupsafe import Markup

from autograder.classroom.nbgrader_bridge.generated_cells import HIDDEN, cell_names, hidden_help
from autograder.classroom.pages.drawings import DrawnRuns
from autograder.classroom.pages.figures import (
    NEEDS_HELP,
    cause,
    exercise_figures,
    lessons_to_repeat,
    who_needs_help,
)
from autograder.classroom.pages.history import Row
from autograder.classroom.pages.plots import bars_svg
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.rendering import drawn, write_html

CLASS_PAGE = "class.html"
INDEX = "index.html"  # the page that lists a student's exercises
FOR_STUDENTS, FOR_INSTRUCTOR = "pages", "instructor"
MAX_LESSONS = 10  # listed on the class page
_TO_INDEX = re.compile(rf'\s*<a href="{re.escape(INDEX)}">[^<]*</a>\.')
UP = "../.."  # from a submission's page to the folder of the class page


def write_class_page(
    folder: Path,
    grades: Sequence[Grade],
    left_out: Sequence[str] = (),
    batch: Mapping[str, str] | None = None,
    history: Sequence[Row] = (),
) -> Path:
    """Write the page on the whole class.

    `left_out`: sentences on folders that could not be read as submissions. `batch`: when and with which versions the
    class was graded, by label. `history`: what the class failed at on earlier days, oldest first.
    """
    students: dict[str, dict[str, Grade]] = {}
    for grade in sorted(grades, key=lambda grade: grade.student):
        students.setdefault(grade.student, {})[grade.exercise] = grade
    exercises = exercise_figures(grades)
    by_status = {
        status: [grade for grade in grades if grade.status == status]
        for status in ("graded", "not graded", "to mark")
    }
    path = folder / CLASS_PAGE
    write_html(
        path,
        "class.html",
        title="The class",
        grades=grades,
        graded=by_status["graded"],
        not_graded=by_status["not graded"],
        to_mark=by_status["to mark"],
        left_out=left_out,
        batch=batch or {},
        needs_help=who_needs_help(grades),
        lessons=lessons_to_repeat(grades)[:MAX_LESSONS],
        threshold=NEEDS_HELP,
        cause=cause,
        exercises=exercises,
        before=lambda exercise, check: [
            row.in_words for row in history if (row.exercise, row.check) == (exercise, check)
        ],
        charts={
            its.exercise: Markup(
                bars_svg(
                    its.bins,
                    title=f"Scores of {its.exercise}",
                    across="points, % of the maximum",
                    up="submissions",
                )
            )
            for its in exercises
            if its.graded
        },
        students=students,
        link=lambda grade: _address(FOR_INSTRUCTOR, grade),
        student_link=lambda grade: _address(FOR_STUDENTS, grade),
        index_link=lambda name: f"{FOR_STUDENTS}/{quote(name, safe='')}/{INDEX}",
    )
    return path


def write_student_page(folder: Path, student: str, grades: Sequence[Grade]) -> None:
    """Write the page that links to a student's pages of the exercises; `grades` has all the student's grades."""
    write_html(
        folder / FOR_STUDENTS / student / INDEX,
        "student.html",
        title=f"Exercises of {student}",
        student=student,
        grades=sorted(map(student_view, grades), key=lambda grade: grade.exercise),
        link=lambda grade: f"{quote(grade.exercise, safe='')}.html",
    )


def write_submission_pages(folder: Path, grade: Grade, drawings: DrawnRuns) -> None:
    """Write the instructor's page, and the student's page, which only shows whether hidden checks passed.

    Raises:
        ValueError: the name of the student or of the exercise is not a valid folder name.
    """
    _write(folder, grade, drawings, for_student=False)
    visible = {check.id for check in grade.checks if not check.hidden}
    seen = {check: svgs for check, svgs in drawings.items() if check in visible}
    _write(folder, student_view(grade), seen, for_student=True)


def page_to_send(folder: Path, student: str, exercise: str) -> str:
    """Return a student's page in a batch's folder, without its link to the other pages; "" if there is none."""
    path = folder / FOR_STUDENTS / student / f"{exercise}.html"
    if not path.is_file():
        return ""
    return _TO_INDEX.sub("", path.read_text(encoding="utf-8"))


def _write(folder: Path, grade: Grade, drawings: DrawnRuns, *, for_student: bool) -> None:
    _require_plain_names(grade)
    top, other = (FOR_STUDENTS, FOR_INSTRUCTOR) if for_student else (FOR_INSTRUCTOR, FOR_STUDENTS)
    write_html(
        folder / top / grade.student / f"{grade.exercise}.html",
        "submission.html",
        title=f"{grade.exercise} · {grade.student}",
        grade=grade,
        drawn=drawn(grade, drawings),
        for_student=for_student,
        other_page=f"{UP}/{_address(other, grade)}",
        class_page=f"{UP}/{CLASS_PAGE}",
        index_page=INDEX,
    )


def _address(top: str, grade: Grade) -> str:
    """Return the relative URL of a submission's page."""
    return f"{top}/{quote(grade.student, safe='')}/{quote(grade.exercise, safe='')}.html"


def _require_plain_names(grade: Grade) -> None:
    for name in (grade.student, grade.exercise):
        if name in ("", ".", "..") or "/" in name or "\0" in name:
            raise ValueError(f"{name!r} cannot be the name of a folder; expected a name without / in it")


def student_view(grade: Grade) -> Grade:
    """Return the grade without titles, inputs and outputs of hidden checks, and without the grader's own errors.

    A grade that is not graded or not completely marked gets no verdicts, because they may still change.
    """
    if grade.status == "not graded":
        return replace(grade, checks=[], reason="")
    if grade.status == "to mark":
        return replace(grade, checks=[replace(each, status="to mark", points=0) for each in grade.checks])
    names = cell_names(grade.checks)
    return replace(grade, checks=[_seen(verdict, names[verdict.id]) for verdict in grade.checks])


def _seen(verdict: CheckVerdict, name: str) -> CheckVerdict:
    if not verdict.hidden:
        return verdict
    passed = verdict.status == "passed"
    return CheckVerdict(
        name,
        name.replace(HIDDEN, "Hidden check "),
        "passed" if passed else "failed",
        verdict.points,
        verdict.max_points,
        help="" if passed else hidden_help(verdict.promise),
        hidden=True,
    )
