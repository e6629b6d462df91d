"""Moodle's gradebook import, or its grading worksheet where that is the roster; one file an exercise.

Formats: https://docs.moodle.org, "Grade import" (mapped by useremail or useridnumber) and "Assignment settings",
offline grading worksheet. Moodle shows feedback as HTML, so ours is escaped.
"""

from __future__ import annotations

import html
from collections.abc import Sequence
from dataclasses import dataclass

from autograder.export.options import Options
from autograder.export.published import Published, UnusableBatch, printable
from autograder.export.tables import (
    Table,
    csv_text,
    is_number,
    key_cell,
    read_table,
    text_cell,
)
from autograder.report.verdict_text import verdict_text

EMAIL, ID_NUMBER = ("useremail", "email address", "email"), ("useridnumber", "id number", "idnumber")
_IDENTIFIER, _NUMBER = "Identifier", "number of the participant"  # "Participant 123456", and its number alone
_GRADE, _COMMENTS, _MOST = "Grade", "Feedback comments", "Maximum grade"
_LONGEST_FEEDBACK = 1000  # characters of one check


@dataclass(frozen=True)
class ClassList:
    """How Moodle finds a student: `key` is the column of its import."""

    key: str
    roster: Table | None = None

    @property
    def is_worksheet(self) -> bool:
        """Whether the roster is an assignment's worksheet, which is handed back filled in."""
        return self.roster is not None and self.roster.index(_IDENTIFIER) is not None

    def row_of(self, student: str) -> Sequence[str]:
        """Return a student's row of the roster; raises `CannotSay` if there is none."""
        assert self.roster
        index = self.roster.index
        keys = [index("student"), index(*EMAIL), index(*ID_NUMBER), index(_NUMBER), index("Full name")]
        return self.roster.row_of(student, keys, index(_NUMBER), index("Full name"))


def open_class(options: Options, students: Sequence[str]) -> ClassList:
    """Find out how students are named.

    Raises:
        UnusableBatch: the roster names nobody in a way that Moodle knows, or the names are of two kinds.
    """
    if options.roster:
        roster = read_table(options.roster)
        identifier = roster.index(_IDENTIFIER)
        if [identifier, roster.index(*EMAIL), roster.index(*ID_NUMBER)].count(None) == 3:
            raise UnusableBatch(
                f"{options.roster} has the columns {', '.join(roster.heading)}; expected useremail or useridnumber "
                "(and student, if the folders are called otherwise), or the worksheet of a Moodle assignment"
            )
        if identifier is not None:
            rows = [[*row, row[identifier].strip().rpartition(" ")[2]] for row in roster.rows]
            roster = Table([*roster.heading, _NUMBER], rows)
        return ClassList("useridnumber" if roster.index(*EMAIL) is None else "useremail", roster)
    with_address = sum("@" in student for student in students)
    if 0 < with_address < len(students):
        raise UnusableBatch(
            "some students are called by an e-mail address and some are not; give a --roster with student and useremail"
        )
    return ClassList("useremail" if with_address else "useridnumber")


def heading_of(class_list: ClassList, exercise: str) -> list[str]:
    """Return the columns of an exercise's file."""
    if class_list.roster and class_list.is_worksheet:
        given = list(class_list.roster.heading[:-1])
        return given + [name for name in (_GRADE, _COMMENTS) if name not in given]
    return [class_list.key, exercise, f"{exercise} feedback"]


def cells_of(class_list: ClassList, published: Published) -> list[str | float]:
    """Return the row of a submission.

    Raises:
        CannotSay: Moodle does not know the student.
        UnusableBatch: in Moodle the assignment has other points.
    """
    words = text_cell(feedback(published))
    if class_list.roster is None:
        return [key_cell(published.student), published.score, words]
    row = class_list.row_of(published.student)
    if class_list.is_worksheet:
        given = dict(zip(class_list.roster.heading, row, strict=True))
        _require_points(given.get(_MOST, ""), published)
        known: dict[str, str | float] = {name: text_cell(cell) for name, cell in given.items()}
        known |= {_GRADE: published.score, _COMMENTS: words}
        return [known[name] for name in heading_of(class_list, published.exercise)]
    column = class_list.roster.index(*(EMAIL if class_list.key == "useremail" else ID_NUMBER))
    assert column is not None
    return [key_cell(row[column].strip()), published.score, words]


def table_text(class_list: ClassList, exercise: str, rows: Sequence[Sequence[str | float]]) -> str:
    """Return the file's content for an exercise."""
    return csv_text(heading_of(class_list, exercise), rows)


def feedback(published: Published) -> str:
    """Return what a student reads beside the points, as HTML: the checks that did not pass, and the hidden sum."""
    lines = [
        f"<b>{_escaped(check.title)}</b> ({check.points:g} of {check.max_points:g} points)<br>"
        f"{_escaped(verdict_text(check, _LONGEST_FEEDBACK))}"
        for check in published.checks
        if check.points < check.max_points
    ]
    passed = len(published.checks) - len(lines)
    lines.insert(0, f"{passed} of {len(published.checks)} visible checks passed.")
    return "<br><br>".join([*lines, *filter(None, [published.hidden_sum])])


def _require_points(most: str, published: Published) -> None:
    """A score of 8 out of 12 would be 8 out of 100 there."""
    if is_number(most) and float(most) != published.max_score:
        raise UnusableBatch(
            f"the worksheet's {_MOST} is {most} and {published.exercise} has {published.max_score} points: set the "
            "assignment in Moodle to as many, and download the worksheet again"
        )


def _escaped(text: str) -> str:
    return html.escape(printable(text)).replace("\n", "<br>")
