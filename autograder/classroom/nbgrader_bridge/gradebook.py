"""Enters grades into nbgrader's gradebook, and generates the feedback pages."""

from __future__ import annotations

import json
import shutil
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode
from nbgrader.api import Gradebook

from autograder.atomic_file import write_atomically
from autograder.classroom.nbgrader_bridge.course_folder import (
    RECORDS,
    RELEASE,
    NbgraderError,
    call,
    open_course,
    write_config_file,
)
from autograder.classroom.nbgrader_bridge.generated_cells import with_generated_cells
from autograder.classroom.nbgrader_bridge.rebuild_submission import rebuild_submission
from autograder.classroom.nbgrader_bridge.source_notebook import read_source
from autograder.engine.exercise import file_names
from autograder.engine.verdict import CheckVerdict, Grade

TIMESTAMP, SECRET = "timestamp.txt", "submission_secret.txt"


@dataclass(frozen=True)
class Entry:
    """A grade and its submission; `sources` is None if the submission could not be read."""

    grade: Grade
    sources: Mapping[str, str] | None
    problem: str = ""
    timestamp: str = ""  # when the submission was handed in, as nbgrader writes it
    secret: str = ""  # identifies the submission when nbgrader's exchange returns the feedback
    late_points: float = 0.0  # deducted for late work: nbgrader's late submission penalty


class CourseGradebook:
    """An nbgrader course folder: gradebook.db, feedback/, and the files that formgrader needs."""

    def __init__(self, folder: Path, solutions: Path) -> None:
        self._folder = folder
        self._solutions = solutions
        folder.mkdir(parents=True, exist_ok=True)
        self._is_new = not (folder / "gradebook.db").exists()
        write_config_file(folder)
        self._course = open_course(folder)
        self._assigned: set[str] = set()

    def enter(self, entry: Entry) -> Path | None:
        """Record one grade and return its feedback page.

        Returns None for a submission that was not graded, whose score is not entered, and for an essay that is not
        completely marked. A grade that was entered before is not entered again.

        Raises `NbgraderError` when nbgrader fails.
        """
        grade = entry.grade
        page = self._folder / "feedback" / grade.student / grade.exercise / f"{grade.exercise}.html"
        if grade.status == "not graded":
            record(self._folder, grade)
            page.unlink(missing_ok=True)  # it would show the points of an earlier grade
            return None
        self._assign(grade.exercise)
        submission = self._submission(entry)
        is_entered = not self._is_new and self._holds(grade, submission)
        if grade.status == "to mark":
            return self._leave_to_a_person(entry, submission, page, is_entered)
        if is_entered and self._is_deducted(entry) and _is_whole(page):
            return page
        page.unlink(missing_ok=True)  # an earlier page would show a grade that is not completely entered
        self._autograde(entry, submission)
        call(self._course.generate_feedback, grade.exercise, grade.student)
        return page

    def as_marked(self, grade: Grade) -> Grade:
        """Return an essay's grade with the points that a person has given so far; any other grade unchanged."""
        if grade.status != "to mark":
            return grade
        with self._course.gradebook as gradebook:
            return with_marks(gradebook, grade)

    def _leave_to_a_person(
        self, entry: Entry, submission: dict[str, str], page: Path, is_entered: bool
    ) -> Path | None:
        """Enter an unmarked essay; make its feedback page when a person has marked every criterion."""
        grade = entry.grade
        page.unlink(missing_ok=True)
        if not (is_entered and self._autograded(grade).exists()):
            shutil.rmtree(self._autograded(grade), ignore_errors=True)
            self._autograde(entry, submission)
            with self._course.gradebook as gradebook:
                ask_again(gradebook, grade)
        else:
            self._deduct(entry)
        if self.as_marked(grade).status != "graded":
            return None
        call(self._course.generate_feedback, grade.exercise, grade.student)
        return page

    def _autograde(self, entry: Entry, submission: dict[str, str]) -> None:
        grade = entry.grade
        record(self._folder, grade)
        self._submit(grade, submission)
        call(self._course.autograde, grade.exercise, grade.student)
        self._deduct(entry)

    def _deduct(self, entry: Entry) -> None:
        """Set nbgrader's late submission penalty, which its autograde has removed."""
        grade = entry.grade
        with self._course.gradebook as gradebook:
            notebook = gradebook.find_submission_notebook(grade.exercise, grade.exercise, grade.student)
            notebook.late_submission_penalty = _penalty(notebook, entry)
            gradebook.db.commit()

    def _is_deducted(self, entry: Entry) -> bool:
        grade = entry.grade
        with self._course.gradebook as gradebook:
            notebook = gradebook.find_submission_notebook(grade.exercise, grade.exercise, grade.student)
            return bool((notebook.late_submission_penalty or 0.0) == _penalty(notebook, entry))

    def _assign(self, exercise: str) -> None:
        """Create the exercise's assignment in the gradebook, with the present points of its checks or criteria."""
        if exercise in self._assigned:
            return
        folder = self._folder / "source" / exercise
        folder.mkdir(parents=True, exist_ok=True)
        nbformat.write(self.source_notebook(exercise), folder / f"{exercise}.ipynb")
        try:
            call(self._course.generate_assignment, exercise)
        except NbgraderError as error:
            advice = "the cells of an assignment with submissions cannot be changed; give another folder"
            raise NbgraderError(f"{error} ({advice})", error.log) from error
        self._assigned.add(exercise)

    def source_notebook(self, exercise: str) -> NotebookNode:
        """Return the notebook from which nbgrader makes the exercise's assignment."""
        return with_generated_cells(read_source(self._solutions / exercise / f"{exercise}.ipynb"), exercise)

    def submitted_notebook(self, entry: Entry) -> NotebookNode:
        """Return the notebook that nbgrader reads as the submission."""
        name = entry.grade.exercise
        release = nbformat.read(self._folder / RELEASE / name / f"{name}.ipynb", as_version=4)
        return rebuild_submission(release, file_names(name), entry.sources, entry.problem)

    def _submission(self, entry: Entry) -> dict[str, str]:
        """Return the files that nbgrader reads: the rebuilt notebook, and timestamp and secret if there are any."""
        files = {f"{entry.grade.exercise}.ipynb": nbformat.writes(self.submitted_notebook(entry)) + "\n"}
        beside = {TIMESTAMP: entry.timestamp, SECRET: entry.secret}
        return files | {name: text for name, text in beside.items() if text}

    def _holds(self, grade: Grade, submission: dict[str, str]) -> bool:
        """Whether this grade of this submission was entered before."""
        folder = self._submitted(grade)
        before = (
            {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}
            if folder.is_dir()
            else {}
        )
        return before == submission and grade.to_json() in _records(self._folder, grade.student)

    def _submit(self, grade: Grade, submission: dict[str, str]) -> None:
        folder = self._submitted(grade)
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name, text in submission.items():
            write_atomically(folder / name, text)

    def _submitted(self, grade: Grade) -> Path:
        """Return the folder in which nbgrader looks for the submission."""
        return self._folder / "submitted" / grade.student / grade.exercise

    def _autograded(self, grade: Grade) -> Path:
        """Return the folder in which nbgrader stores the autograded notebook."""
        return self._folder / "autograded" / grade.student / grade.exercise


def _penalty(notebook: Any, entry: Entry) -> float:
    """Return the points that nbgrader deducts for late work: at most the score of the `notebook`."""
    return min(entry.late_points, float(notebook.score))


def _is_whole(page: Path) -> bool:
    """Whether a page is complete; it is incomplete if nbgrader was killed while it wrote the page."""
    return page.exists() and page.read_bytes().rstrip().endswith(b"</html>")


def record(folder: Path, grade: Grade) -> None:
    """Write a grade to the student's JSON file, in place of an earlier grade for the same exercise."""
    others = [record for record in _records(folder, grade.student) if record["exercise"] != grade.exercise]
    grades = sorted([*others, grade.to_json()], key=lambda record: record["exercise"])
    path = folder / RECORDS / f"{grade.student}.json"
    write_atomically(path, json.dumps(grades, indent=2) + "\n")


def _records(folder: Path, student: str) -> list[dict[str, Any]]:
    path = folder / RECORDS / f"{student}.json"
    return json.loads(path.read_text()) if path.exists() else []


def with_marks(gradebook: Gradebook, grade: Grade) -> Grade:
    """Return an essay's grade with the points given so far; raises `MissingEntry` if it is not in the gradebook."""
    return replace(grade, checks=[_marked(gradebook, grade, verdict) for verdict in grade.checks])


def ask_again(gradebook: Gradebook, grade: Grade) -> None:
    """Mark the criteria as needing manual grading again; a person must confirm the points of the earlier submission."""
    for verdict in grade.checks:
        _entry(gradebook, grade, verdict).needs_manual_grade = True
    gradebook.db.commit()


def _marked(gradebook: Gradebook, grade: Grade, verdict: CheckVerdict) -> CheckVerdict:
    entry = _entry(gradebook, grade, verdict)
    if entry.needs_manual_grade:
        return replace(verdict, status="to mark", points=0)
    points = float(entry.score)
    return replace(verdict, status="marked", points=int(points) if points.is_integer() else points)


def _entry(gradebook: Gradebook, grade: Grade, verdict: CheckVerdict) -> Any:
    """Return nbgrader's record of one criterion."""
    return gradebook.find_grade(verdict.id, grade.exercise, grade.exercise, grade.student)
