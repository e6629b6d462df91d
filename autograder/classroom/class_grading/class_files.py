"""The files of a graded class: gradebook, grades, record, programs and pages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import datetime, timezone
from pathlib import Path

from autograder.classroom.batch.batch_record import BatchRecord, write_batch
from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.records import GRADES, write_grades
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.source_files import graded_sources, write_base_code, write_source
from autograder.classroom.dates import Deadlines
from autograder.classroom.nbgrader_bridge.course_folder import RELEASE, NbgraderError
from autograder.classroom.nbgrader_bridge.gradebook import CourseGradebook, Entry
from autograder.classroom.nbgrader_bridge.rebuild_submission import NoSolutionCell
from autograder.classroom.pages.drawings import Drawings
from autograder.classroom.pages.history import read_history, with_day, write_history
from autograder.classroom.pages.pages import write_class_page, write_student_page, write_submission_pages
from autograder.engine.essay import load_essay, unmarked_grade
from autograder.engine.exercise import essay_names, exercises_folder
from autograder.engine.verdict import Grade, Late

LOG = "nbgrader.log"


class ClassFiles:
    """The files in the output folder of a class.

    Attributes:
        record: the record of the batch, for batch.json and the class page; None if a merged shard has no record.

    Args:
        out: the output folder.
        before: earlier grades, kept for submissions without a new one.
        record: the present record of the batch.
        json_file: a second file for all verdicts.
        drawn_in: output folders with drawings of failed checks; by default `out`.
        deadlines: due times and what late work costs; None: nothing is late.
    """

    def __init__(
        self,
        out: Path,
        before: Sequence[Grade],
        record: BatchRecord | None,
        *,
        json_file: Path | None = None,
        drawn_in: Sequence[Path] = (),
        deadlines: Deadlines | None = None,
    ) -> None:
        self.record = record
        self._out = out
        self._grades = {(grade.student, grade.exercise): grade for grade in before}
        self._json_file = json_file
        self._deadlines = deadlines
        self._timestamps = {
            (row.student, row.exercise): row.handed_in for row in (record.rows if record else ())
        }
        self._drawings = [Drawings(folder) for folder in drawn_in or (out,)]
        self._gradebook: CourseGradebook | None = None
        self._problems: dict[tuple[str, str], Exception] = {}

    @property
    def grades(self) -> Sequence[Grade]:
        """All grades, in order of student and exercise, with a person's marks and the deductions for late work."""
        return self._with_late([self._grades[key] for key in sorted(self._grades)])

    @property
    def deadline_notes(self) -> Sequence[str]:
        """Sentences on late work for the instructor, such as submissions whose time is unknown."""
        return self._deadlines.notes(self.grades, self._timestamps) if self._deadlines else []

    def add(self, result: Graded) -> None:
        """Enter a result into the gradebook, and write its program and its pages."""
        work, key = result.work, (result.work.student, result.work.exercise)
        self._timestamps[key], self._grades[key] = work.timestamp, result.grade
        self._grades[key] = self._entered(result, self._of_student(work.student)[work.exercise].late)
        theirs = self._of_student(work.student)
        self._grades[key] = grade = theirs[work.exercise]
        write_source(self._out, result)
        write_base_code(self._out, grade.exercise, self._out / RELEASE)
        drawn = {
            check: svgs for one in self._drawings for check, svgs in one.of(grade, result.sources).items()
        }
        write_submission_pages(self._out, grade, drawn)
        write_student_page(self._out, grade.student, list(theirs.values()))

    def outdated(self, works: Sequence[Work]) -> list[Graded]:
        """Return the results whose deduction for late work has changed since they were added, to be added again."""
        now = {(grade.student, grade.exercise): grade for grade in self.grades}
        keys = [(work.student, work.exercise) for work in works]
        return [
            self._kept(work, now[key])
            for work, key in zip(works, keys, strict=True)
            if key in now and now[key].late != self._grades[key].late
        ]

    def _kept(self, work: Work, grade: Grade) -> Graded:
        """Return the result of an earlier run; the points that a person gave an essay are in the gradebook."""
        if work.exercise in essay_names():
            grade = unmarked_grade(load_essay(work.exercise), work.student)
        sources = graded_sources(self._out, work.exercise, work.student)
        problem = "" if sources or not grade.checks else grade.checks[0].observed
        return Graded(work, replace(grade, late=None), sources, problem, cached=True)

    def _of_student(self, student: str) -> Mapping[str, Grade]:
        """Return a student's grades by exercise."""
        theirs = [grade for grade in self._grades.values() if grade.student == student]
        return {grade.exercise: grade for grade in self._with_late(theirs)}

    def _with_late(self, grades: Sequence[Grade]) -> Sequence[Grade]:
        if self._deadlines:
            return self._deadlines.applied(grades, self._timestamps)
        return [replace(grade, late=None) for grade in grades]

    def write(self, refused: Sequence[str] = ()) -> Path:
        """Write the files on the whole class and return its page; `refused`: sentences on unreadable folders."""
        grades, words = self.grades, None
        for path in filter(None, (self._out / GRADES, self._json_file)):
            write_grades(path, grades)
        if self.record:
            record = self.record.with_points(grades)
            write_batch(self._out, record)
            words = record.in_words()
        today = datetime.now(timezone.utc).date().isoformat()
        history = with_day(read_history(self._out), today, grades)
        write_history(self._out, history)
        earlier = [row for row in history if row.day != today]
        return write_class_page(self._out, grades, refused, batch=words, history=earlier)

    def problems(self) -> list[str]:
        """Return a sentence on each grade that is not in the gradebook, and write nbgrader's output to a file."""
        found = {key: f"{key[0]}'s {key[1]}: {error}" for key, error in self._problems.items()}
        logs = [
            f"{found[key]}\n{error.log}"
            for key, error in self._problems.items()
            if isinstance(error, NbgraderError)
        ]
        if logs:
            (self._out / LOG).write_text("\n\n".join(logs))
        return [*found.values(), *([f"nbgrader's output is in {self._out / LOG}"] if logs else [])]

    def _entered(self, result: Graded, late: Late | None) -> Grade:
        """Enter a grade and its deduction into the gradebook; return the grade with the points that a person gave."""
        work = result.work
        self._problems.pop((work.student, work.exercise), None)
        try:
            gradebook = self._gradebook = self._gradebook or CourseGradebook(self._out, exercises_folder())
            lost = late.points if late else 0.0
            entry = Entry(result.grade, result.sources, result.problem, work.timestamp, work.secret, lost)
            gradebook.enter(entry)
            return gradebook.as_marked(result.grade)
        except (NbgraderError, NoSolutionCell, OSError) as error:
            self._problems[work.student, work.exercise] = error
            return result.grade
