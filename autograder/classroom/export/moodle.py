"""Moodle's gradebook import, or its grading worksheet if the roster is one; one file per exercise.

Formats: https://docs.moodle.org, "Grade import" (mapped by useremail or useridnumber), and for the offline grading
worksheet mod/assign/gradingtable.php and mod/assign/feedback/offline/importgradeslib.php of
https://github.com/moodle/moodle. The worksheet's headings are in the user's language, and Moodle imports them in that
language only; the order of the columns is the same in all languages. Moodle shows feedback as HTML, so it is escaped.
For “Upload multiple feedback files in a zip” see mod/assign/feedback/file/importziplib.php: a file's name begins with
a name, the participant's number in the worksheet, and the plugin that a download names, separated by underscores.
"""

from __future__ import annotations

import html
import io
import re
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from autograder.classroom.export.published import Options, Published, UnusableBatch, printable
from autograder.classroom.export.tables import Table, csv_text, key_cell, read_number, read_table, text_cell
from autograder.report.table import verdict_text

EMAIL, ID_NUMBER = ("useremail", "email address", "email"), ("useridnumber", "id number", "idnumber")
_PARTICIPANT = re.compile(r"(?P<word>.*\D)(?P<number>\d+)\s*")  # "Participant 123456", in any language
_TIME = re.compile(r"-|.*\d\d? ?[:.hH] ?\d\d.*", re.DOTALL)  # "-" is a grade that was never changed
_MAX_FEEDBACK_LENGTH = 1000  # characters of one check


@dataclass(frozen=True)
class Worksheet:
    """The indices of the columns of an assignment's worksheet; the column after `grade` has the maximum grade.

    `feedback` is None if feedback comments are off in the assignment's settings.
    """

    grade: int
    feedback: int | None


@dataclass(frozen=True)
class ClassList:
    """Identifies students: `key` is the column of Moodle's gradebook import; a worksheet is filled in instead.

    `pages` are the students' pages to give back with a worksheet, by student; "" if there is none.
    """

    key: str
    roster: Table | None = None
    worksheet: Worksheet | None = None
    pages: Mapping[str, str] = field(default_factory=dict)

    def cells(self, published: Published) -> list[str | float]:
        """Return the row of a submission.

        Raises:
            CannotExpress: Moodle does not know the student.
            UnusableBatch: the assignment's maximum grade in Moodle is not that of the exercise.
        """
        words = text_cell(feedback(published))
        if self.roster is None:
            return [key_cell(published.student), published.score, words]
        row = self._row_of(published.student)
        if self.worksheet is None:
            column = self.roster.index(*(EMAIL if self.key == "useremail" else ID_NUMBER))
            assert column is not None
            return [key_cell(row[column].strip()), published.score, words]
        title, most = (line[self.worksheet.grade + 1] for line in (self.roster.heading, row))
        if read_number(most) != published.max_score:  # 8 of 12 points would become 8 of 100 in Moodle
            raise UnusableBatch(
                f"the worksheet's {title} is {most}, but {published.exercise} has {published.max_score} points: set "
                f"the assignment's maximum in Moodle to {published.max_score}, and download the worksheet again"
            )
        filled: list[str | float] = [text_cell(cell) for cell in row]
        filled[self.worksheet.grade] = published.score
        if self.worksheet.feedback is not None:
            filled[self.worksheet.feedback] = words
        return filled

    def text(self, exercise: str, max_score: float, rows: Sequence[Sequence[str | float]]) -> str:
        """Return the file's content for an exercise."""
        if self.roster and self.worksheet:
            return csv_text(self.roster.heading, rows)
        return csv_text([self.key, exercise, f"{exercise} feedback"], rows)

    def feedback_zip(self, exercise: str, rows: Mapping[str, Sequence[str | float]]) -> bytes:
        """Return a zip file with the pages of the students who have a row in the worksheet; b"" without any page."""
        file = io.BytesIO()
        with zipfile.ZipFile(file, "w") as archive:
            for student, row in rows.items():
                participant = _PARTICIPANT.fullmatch(str(row[0]))
                if participant and self.pages.get(student):
                    number = participant["number"]
                    name = student.removesuffix(f"-{number}").replace("_", "-")
                    entry = zipfile.ZipInfo(f"{name}_{number}_assignsubmission_file_{exercise}.html")
                    archive.writestr(entry, self.pages[student], zipfile.ZIP_DEFLATED)
            is_empty = not archive.namelist()
        return b"" if is_empty else file.getvalue()

    def _row_of(self, student: str) -> Sequence[str]:
        """Return a student's row of the roster; raises `CannotExpress` if there is none."""
        assert self.roster
        index = self.roster.index
        if not self.worksheet:
            keys = [index("student"), index(*EMAIL), index(*ID_NUMBER), index("Full name")]
            return self.roster.row_of(student, keys, None, [])
        people = [*range(1, self.worksheet.grade), index("student")]
        width = len(self.roster.heading)
        people_and_numbers = [
            [*row, match["number"], match["word"]]
            for row in self.roster.rows
            if (match := _PARTICIPANT.fullmatch(row[0]))
        ]
        numbered = Table([*self.roster.heading, "number of the participant", ""], people_and_numbers)
        # In an anonymous download all names are the same word before the number.
        return numbered.row_of(student, [*people, width], width, [1, width + 1])[:width]

    def notes(self, options: Options) -> list[str]:
        """Return sentences on data that Moodle may not receive."""
        found = self.roster.notes(options.roster) if self.roster else []
        if not self.worksheet:
            found.append(
                "no zip of feedback files: only the assignment's grading worksheet has the numbers by which Moodle "
                "finds the student of such a file; give it as --roster"
            )
        if missing := [student for student, page in self.pages.items() if not page]:
            found.append(f"no feedback file, because the grades' folder has no page: {', '.join(missing)}")
        if self.worksheet and self.worksheet.feedback is None:
            found.append(
                f"{options.roster} has no column for feedback: “Feedback comments” is off in the assignment's settings"
            )
        return found


def open_class(options: Options, scored: Sequence[Published]) -> ClassList:
    """Read the roster, or choose by the folders' names whether e-mail addresses or id numbers identify students.

    Raises:
        UnusableBatch: the roster has no column that Moodle can import, or is a worksheet and the grades are for
            several exercises, or only some folders' names are addresses.
    """
    if options.roster:
        roster = read_table(options.roster)
        if worksheet := _worksheet(roster):
            exercises = sorted({published.exercise for published in scored})
            if len(exercises) > 1:
                raise UnusableBatch(
                    f"{options.roster} is the worksheet of one assignment, but there are grades for "
                    f"{', '.join(exercises)}: choose one with --exercise NAME"
                )
            pages = {one.student: options.page_of(one.student, one.exercise) for one in scored}
            return ClassList("", roster, worksheet, pages)
        email, id_number = roster.index(*EMAIL), roster.index(*ID_NUMBER)
        if (email is None and id_number is None) or _has_participants(roster):
            raise UnusableBatch(
                f"{options.roster} has the columns {', '.join(roster.heading)}; expected useremail or useridnumber "
                "(and student, if the folders have other names), or the grading worksheet of a Moodle assignment that "
                "is graded by points, with a column for grades and the maximum grade after it"
            )
        return ClassList("useridnumber" if email is None else "useremail", roster)
    with_address = sum("@" in published.student for published in scored)
    if 0 < with_address < len(scored):
        raise UnusableBatch(
            "only some students' folders have an e-mail address as name; give a --roster with the columns student and "
            "useremail"
        )
    return ClassList("useremail" if with_address else "useridnumber")


def _has_participants(roster: Table) -> bool:
    """Whether the first column is a worksheet's: the same word with a number in every row, under another heading."""
    words = {match["word"] if (match := _PARTICIPANT.fullmatch(cell)) else "" for cell in roster.column(0)}
    return (
        len(words) == 1
        and words != {""}
        and roster.heading[0].strip().lower() not in ("student", *EMAIL, *ID_NUMBER)
    )


def _worksheet(roster: Table) -> Worksheet | None:
    """Find the columns of a worksheet by their contents; None for another table, or a worksheet with a scale."""
    if not _has_participants(roster):
        return None
    grades = [
        i for i in range(1, len(roster.heading) - 1) if _are_grades(roster.column(i), roster.column(i + 1))
    ]
    if not grades:
        return None
    behind = range(grades[-1] + 2, len(roster.heading))
    times = [i for i in behind if all(map(_TIME.fullmatch, roster.column(i)))]
    last_change = max(times, default=len(roster.heading))
    return Worksheet(grades[-1], last_change + 1 if last_change + 1 < len(roster.heading) else None)


def _are_grades(grades: Sequence[str], most: Sequence[str]) -> bool:
    """Whether a column can hold grades: the next column has the same maximum of points in every row."""
    points = {read_number(cell) for cell in most}
    highest = points.pop()
    if points or not highest:
        return False
    given = [read_number(cell) for cell in grades if cell]
    return all(grade is not None and grade <= highest for grade in given)


def feedback_file(exercise: str) -> str:
    """Return the name of the zip file with the students' pages."""
    return f"{exercise}_feedback.zip"


def feedback(published: Published) -> str:
    """Return the feedback to a student as HTML: the checks that did not pass, and the points of the hidden checks."""
    lines = [
        f"<b>{_escaped(check.title)}</b> ({check.points:g} of {check.max_points:g} points)<br>"
        f"{_escaped(verdict_text(check, _MAX_FEEDBACK_LENGTH))}"
        for check in published.checks
        if check.points < check.max_points
    ]
    passed = len(published.checks) - len(lines)
    lines.insert(0, f"{passed} of {len(published.checks)} visible checks passed.")
    return "<br><br>".join([*lines, *filter(None, [published.hidden_sum, _escaped(published.late)])])


def _escaped(text: str) -> str:
    return html.escape(printable(text)).replace("\n", "<br>")
