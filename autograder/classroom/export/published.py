"""What of a grade leaves the grader: visible checks whole, and of the hidden ones the sum of their points."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from autograder.classroom.batch.collection import STUDENT
from autograder.engine.verdict import CheckVerdict, Grade
from ros_runtime.course_error import CourseError

HiddenPolicy = Literal["hide", "show"]
NOT_GRADED = "The grader could not judge this submission. That is no zero: it will be graded again."
TO_MARK = "This waits for a person's marks."

# What XML, terminals and spreadsheets cannot take: control characters but tab and newline, halves of surrogate pairs.
_UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")


class CannotSay(Exception):
    """A platform's format cannot say this one thing; the message says why, and what to do."""


class UnusableBatch(CourseError):
    """The grades or the options cannot be used; the message says what was found and what is expected."""


@dataclass(frozen=True)
class Published:
    """A graded submission as it is given away.

    Attributes:
        checks: to be shown with all they say.
        hidden: to be summed up, or given to instructors alone.
    """

    student: str
    exercise: str
    score: float
    max_score: float
    checks: Sequence[CheckVerdict]
    hidden: Sequence[CheckVerdict]

    @property
    def hidden_points(self) -> float:
        """The points of the hidden checks together."""
        return number(sum(check.points for check in self.hidden))

    @property
    def hidden_max_points(self) -> float:
        """The points that there are for the hidden checks together."""
        return number(sum(check.max_points for check in self.hidden))

    @property
    def hidden_sum(self) -> str:
        """The sentence that stands in the place of the hidden checks; "" where there are none."""
        if not self.hidden:
            return ""
        return f"hidden checks: {self.hidden_points:g} of {self.hidden_max_points:g} points"


def publish(grade: Grade, hidden: HiddenPolicy) -> Published:
    """Return what of a graded submission is given away; with "show" no check is treated as hidden."""
    assert grade.score is not None
    kept_back = [check for check in grade.checks if check.hidden and hidden == "hide"]
    return Published(
        grade.student,
        grade.exercise,
        number(grade.score),
        number(grade.max_score),
        [check for check in grade.checks if check not in kept_back],
        kept_back,
    )


def why_no_score(grade: Grade) -> str:
    """Return why there is no score to give away, in words for anybody: "" if there is one."""
    return {"graded": "", "not graded": "not graded", "to mark": "not marked yet"}[grade.status]


def words_for_students(grade: Grade) -> str:
    """Return what a student reads in place of a score. The grader's own reason may name a hidden check."""
    return TO_MARK if grade.status == "to mark" else NOT_GRADED


def require_safe_names(grades: Sequence[Grade]) -> None:
    """Require names that can be those of files, and one grade for each student and exercise.

    Raises:
        UnusableBatch: a name cannot be used, or two grades are for the same work.
    """
    seen: set[tuple[str, str]] = set()
    for grade in grades:
        if not STUDENT.fullmatch(grade.student):
            raise UnusableBatch(
                f"{grade.student!r} is no name of a student: expected letters, digits and . , _ - @ + ' only"
            )
        if not grade.exercise.isidentifier():
            raise UnusableBatch(f"{grade.exercise!r} is no name of an exercise")
        if (grade.student, grade.exercise) in seen:
            raise UnusableBatch(f"{grade.student} has two grades for {grade.exercise}; expected one")
        seen.add((grade.student, grade.exercise))


def printable(text: str) -> str:
    """Return text that every format can hold: what a student's program printed may be anything."""
    return _UNPRINTABLE.sub("\N{REPLACEMENT CHARACTER}", text.replace("\r\n", "\n"))


def number(value: float) -> float:
    """Return 3 for 3.0, and 2.5 as it is."""
    return int(value) if float(value).is_integer() else value
