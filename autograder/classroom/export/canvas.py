"""Canvas' gradebook import, one file per exercise, because an empty cell in a common file would count as a grade.

Format: lib/gradebook_exporter.rb and lib/gradebook_importer.rb of https://github.com/instructure/canvas-lms. Headings
are English in every language; the format of numbers and the separator follow the language. An account may split the
students' names into two columns. The roster is the file that Canvas' gradebook exports. Without a roster the folders'
names are used as SIS login ids. For a column without an assignment's id, Canvas makes a new assignment, and asks before
it does so.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from autograder.classroom.export.published import CannotExpress, Options, Published, UnusableBatch
from autograder.classroom.export.tables import Table, csv_text, key_cell, read_number, read_table, text_cell

_BEFORE_ASSIGNMENTS = (
    "Student",
    "ID",
    "SIS User ID",
    "SIS Login ID",
    "Integration ID",
    "Root Account",
    "Section",
)
_KEYS = ("SIS Login ID", "SIS User ID", "ID", "Student")
_POINTS = "Points Possible"
_ASSIGNMENT = re.compile(r"(?P<title>.+) \((?P<id>\d+)\)")
# The name that `course collect` gives to a student in an anonymous download.
_ANONYMOUS = re.compile(r"anon_[A-Za-z0-9]{5}")


@dataclass(frozen=True)
class Gradebook:
    """Canvas' roster of the class, and the column of each exercise."""

    students: Table | None  # without the row “Points Possible”
    assignments: dict[str, str]  # heading of the assignment's column, by exercise
    points: dict[str, str]  # the assignment's points in Canvas, by exercise, for assignments in the roster

    def notes(self, options: Options) -> list[str]:
        """Return sentences on effects in Canvas that may not be intended."""
        new = [exercise for exercise, title in self.assignments.items() if not _ASSIGNMENT.fullmatch(title)]
        found = self.students.notes(options.roster) if self.students else []
        found += [
            f"Canvas will make a new assignment {exercise}; for an existing one give --assignment {exercise}=ID, with "
            "the number at the end of the address of its page as ID"
            for exercise in new
        ]
        found += [
            f"without a roster the points of {title} in Canvas are unknown: make sure that they equal the file's points"
            for exercise, title in self.assignments.items()
            if exercise not in new and exercise not in self.points
        ]
        if self.students is None:
            found.append(
                "the folders' names are used as SIS login ids; give --roster FILE to look the students up"
            )
        return found

    def cells(self, published: Published) -> list[str | float]:
        """Return the row of a submission.

        Raises:
            CannotExpress: Canvas does not know the student.
            UnusableBatch: the assignment's maximum in Canvas is not that of the exercise.
        """
        exercise, points = published.exercise, published.max_score
        worth = self.points.get(exercise)
        if (
            worth is not None and read_number(worth) != points
        ):  # 8 of 12 points would become 8 of 100 in Canvas
            raise UnusableBatch(
                f"{self.assignments[exercise]} has {worth or 'no'} points in Canvas, but {exercise} has {points}: set "
                f"the assignment in Canvas to {points} points, and export Canvas' gradebook again"
            )
        return [*self._person(published.student), published.score]

    def text(self, exercise: str, max_score: float, rows: Sequence[Sequence[str | float]]) -> str:
        """Return the file's content for an exercise."""
        heading = self._heading()
        points: list[str | float] = [f"    {_POINTS}", *[""] * (len(heading) - 1), max_score]
        return csv_text([*heading, text_cell(self.assignments[exercise])], [points, *rows])

    def _heading(self) -> list[str]:
        """Return the headings of the columns before the assignment's column, in Canvas' order."""
        if self.students is None:
            return ["Student", "ID", "SIS User ID", "SIS Login ID", "Section"]
        return [name for name in _BEFORE_ASSIGNMENTS if self.students.index(name) is not None]

    def _person(self, student: str) -> list[str]:
        """Return a student's cells in these columns; raises `CannotExpress` if the roster lacks the student."""
        if _ANONYMOUS.fullmatch(student):
            raise CannotExpress(
                "this name is from an anonymous download, and Canvas' gradebook imports no anonymous grades: show the "
                "names in Canvas, then collect and grade a new download"
            )
        if self.students is None:
            return [text_cell(student), "", "", key_cell(student), ""]
        index = self.students.index
        row = self.students.row_of(student, [index(name) for name in _KEYS], index("ID"), [index("Student")])
        return [
            (text_cell if name in ("Student", "Section") else key_cell)(row[index(name) or 0])
            for name in self._heading()
        ]


def open_class(options: Options, scored: Sequence[Published]) -> Gradebook:
    """Read the roster and find each exercise's column.

    Raises:
        UnusableBatch: the roster is not an export of Canvas' gradebook, or an assignment's id is invalid.
    """
    table = _with_whole_names(read_table(options.roster)) if options.roster else None
    titles: dict[str, str] = {}
    titled: dict[str, str] = {}
    students = None
    if table:
        if [table.index(name) for name in ("Student", "ID", "Section")].count(None):
            raise UnusableBatch(
                f"{options.roster} begins with the columns {', '.join(table.heading[:4])}; expected the export of "
                "Canvas' gradebook, with Student, ID and Section (or LastName and FirstName in place of Student)"
            )
        found = [match for title in table.heading if (match := _ASSIGNMENT.fullmatch(title.strip()))]
        titles = {match["id"]: match["title"] for match in found}
        titled = {match["title"]: match["id"] for match in reversed(found)}
        worth = next((row for row in table.rows if _POINTS in row[0]), [""] * len(table.heading))
        students = replace(table, rows=[row for row in table.rows if _POINTS not in row[0]])
    columns, points = {}, {}
    for exercise in sorted({published.exercise for published in scored}):
        number = options.assignments.get(exercise) or titled.get(exercise)
        if number and not number.isdigit():
            raise UnusableBatch(f"--assignment {exercise}={number}: expected a number as Canvas' id")
        columns[exercise] = f"{titles.get(number, exercise)} ({number})" if number else exercise
        if table and number and (column := table.index(columns[exercise])) is not None:
            points[exercise] = worth[column]
    return Gradebook(students, columns, points)


def _with_whole_names(table: Table) -> Table:
    """Return the table with a column Student, "Last, First", if the account exports LastName and FirstName."""
    last, first = table.index("LastName"), table.index("FirstName")
    if last is None or first is None:
        return table
    rows = [[f"{row[last]}, {row[first]}".strip(", "), *row] for row in table.rows]
    return replace(table, heading=["Student", *table.heading], rows=rows)
