"""The part of a grade that may be published: the visible checks, and the total points of the hidden checks."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Literal

from autograder.classroom.batch.collection import STUDENT
from autograder.engine.verdict import CheckVerdict, Grade
from ros_runtime.course_error import CourseError

HiddenPolicy = Literal["hide", "show"]
NOT_GRADED = "The grader could not judge this submission. This is not a zero: it will be graded again."
TO_MARK = "This has not been marked by a person yet."

# Invalid in XML, terminals or spreadsheets: control characters except tab and newline, and halves of surrogate pairs.
_UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")


class CannotExpress(Exception):
    """A platform's format cannot express this grade; the message says why, and what to do."""


class UnusableBatch(CourseError):
    """The grades or the options cannot be used; the message says what was found and what is expected."""


@dataclass(frozen=True)
class Published:
    """A graded submission in the form to publish.

    Attributes:
        checks: the checks to show in full.
        hidden: the checks of which students see only the total points.
        late: the sentence on a late submission; "" if it was not late.
    """

    student: str
    exercise: str
    score: float
    max_score: float
    checks: Sequence[CheckVerdict]
    hidden: Sequence[CheckVerdict]
    late: str = ""

    @property
    def hidden_points(self) -> float:
        """The total points of the hidden checks."""
        return number(sum(check.points for check in self.hidden))

    @property
    def hidden_max_points(self) -> float:
        """The maximum of the total points of the hidden checks."""
        return number(sum(check.max_points for check in self.hidden))

    @property
    def hidden_sum(self) -> str:
        """The line that students see in place of the hidden checks; "" if there are none."""
        if not self.hidden:
            return ""
        return f"hidden checks: {self.hidden_points:g} of {self.hidden_max_points:g} points"


def publish(grade: Grade, hidden: HiddenPolicy) -> Published:
    """Return the form of a graded submission to publish; if `hidden` is "show", no check is treated as hidden."""
    assert grade.score is not None
    hidden_checks = [check for check in grade.checks if check.hidden and hidden == "hide"]
    return Published(
        grade.student,
        grade.exercise,
        number(grade.score),
        number(grade.max_score),
        [check for check in grade.checks if check not in hidden_checks],
        hidden_checks,
        grade.late.reason if grade.late else "",
    )


def why_no_score(grade: Grade) -> str:
    """Return the reason for a missing score, without confidential details; "" if there is a score."""
    return {"graded": "", "not graded": "not graded", "to mark": "not marked yet"}[grade.status]


def text_without_score(grade: Grade) -> str:
    """Return the text that students see in place of a score; the grader's reason may name hidden checks."""
    return TO_MARK if grade.status == "to mark" else NOT_GRADED


def require_safe_names(grades: Sequence[Grade]) -> None:
    """Require names that are valid file names, and one grade for each student and exercise.

    Raises:
        UnusableBatch: a name is not a valid file name, or a student has two grades for an exercise.
    """
    seen: set[tuple[str, str]] = set()
    for grade in grades:
        if not STUDENT.fullmatch(grade.student):
            raise UnusableBatch(
                f"{grade.student!r} is not a valid name of a student: expected letters, digits and . , _ - @ + ' only"
            )
        if not grade.exercise.isidentifier():
            raise UnusableBatch(f"{grade.exercise!r} is not a valid name of an exercise")
        if (grade.student, grade.exercise) in seen:
            raise UnusableBatch(f"{grade.student} has two grades for {grade.exercise}; expected one")
        seen.add((grade.student, grade.exercise))


def printable(text: str) -> str:
    """Return the text without characters that a format does not allow, because students' programs may print them."""
    return _UNPRINTABLE.sub("\N{REPLACEMENT CHARACTER}", text.replace("\r\n", "\n"))


def number(value: float) -> float:
    """Return 3 for 3.0, and 2.5 as it is."""
    return int(value) if float(value).is_integer() else value


@dataclass(frozen=True)
class Options:
    """The choices for one export.

    Attributes:
        graded_at: when the grades were written, UTC.
        hidden: "hide": students see only the total points of hidden checks; "show": hidden checks are shown in full.
        roster: a table of the class, exported from the platform.
        assignments: the platform's id of an exercise's assignment, by the exercise's name.
        classroom: the name of the Classroom 50 classroom.
        environment: the process's environment variables, for jobs that run on the platform.
        page_of: returns a student's page of an exercise, as HTML without links to other pages; "" if there is none.
    """

    graded_at: datetime
    hidden: HiddenPolicy = "hide"
    roster: Path | None = None
    assignments: Mapping[str, str] = field(default_factory=dict)
    classroom: str = ""
    environment: Mapping[str, str] = field(default_factory=dict)
    page_of: Callable[[str, str], str] = lambda student, exercise: ""
