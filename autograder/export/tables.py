"""Tables for spreadsheets and gradebooks: written so that no cell is taken for a formula, read with bounds."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from pathlib import Path

from autograder.export.published import CannotSay, UnusableBatch, number, printable

MOST_BYTES = 20_000_000  # of a roster
# What begins a formula, also in the wide form that some spreadsheets take for the same.
_FORMULA = (
    *("=", "+", "-", "@"),
    "\N{FULLWIDTH EQUALS SIGN}",
    "\N{FULLWIDTH PLUS SIGN}",
    "\N{FULLWIDTH HYPHEN-MINUS}",
    "\N{FULLWIDTH COMMERCIAL AT}",
)


@dataclass(frozen=True)
class Table:
    """A heading and its rows, all as long as the heading."""

    heading: Sequence[str]
    rows: Sequence[Sequence[str]]

    def index(self, *names: str) -> int | None:
        """Return the first column that has one of these names, in any case; None if there is none."""
        lowered = [title.strip().lower() for title in self.heading]
        return next((lowered.index(name.lower()) for name in names if name.lower() in lowered), None)

    def row_of(
        self, student: str, columns: Iterable[int | None], numbers: int | None, names: int | None
    ) -> Sequence[str]:
        """Return the row in which one of the columns has the student's name.

        `course collect` puts the platform's own number at the end of a name. It is looked for in the column `numbers`;
        then the rest of the name has to be like that in the column `names`, since a name may end so by chance.

        Raises:
            CannotSay: there is none, or more than one, or it is somebody else's.
        """
        wanted = [(column, student) for column in columns if column is not None]
        name, its_number = _collected(student)
        if its_number and numbers is not None:
            wanted.append((numbers, its_number))
        for column, value in wanted:
            found = [row for row in self.rows if _cell_value(row[column]) == value]
            if len(found) > 1:
                raise CannotSay(
                    f"{value} stands in {len(found)} rows of the roster, column {self.heading[column]}"
                )
            if found and value != student and names is not None and not _alike(name, found[0][names]):
                raise CannotSay(f"number {value} is {found[0][names]}'s in the roster: enter it by hand")
            if found:
                return found[0]
        looked_in = ", ".join(dict.fromkeys(self.heading[column] for column, _ in wanted))
        raise CannotSay(f"the roster has no such student (looked in {looked_in})")


def read_table(path: Path) -> Table:
    """Read a CSV file that a platform gave out.

    Raises:
        UnusableBatch: it is no such file.
    """
    try:
        if path.stat().st_size > MOST_BYTES:
            raise UnusableBatch(
                f"{path} has more than {MOST_BYTES // 1_000_000} MB; expected a table of a class"
            )
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise UnusableBatch(f"{path} cannot be read: {error}") from error
    first = text.partition("\n")[0]
    delimiter = max(",;\t", key=first.count)
    try:
        lines = [line for line in csv.reader(io.StringIO(text, newline=""), delimiter=delimiter) if any(line)]
    except csv.Error as error:
        raise UnusableBatch(f"{path} is not a CSV file: {error}") from error
    if not lines:
        raise UnusableBatch(f"{path} is empty; expected a heading and a row for each student")
    width = len(lines[0])
    return Table(lines[0], [(line + [""] * width)[:width] for line in lines[1:]])


def csv_text(heading: Sequence[str], rows: Iterable[Sequence[str | float]]) -> str:
    """Return a CSV file's content; every cell has been made by one of the functions below, or is a number."""
    file = io.StringIO(newline="")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(heading)
    writer.writerows([[cell if isinstance(cell, str) else number(cell) for cell in row] for row in rows])
    return file.getvalue()


def text_cell(text: str) -> str:
    """Return words that no spreadsheet takes for a formula: an apostrophe stands before such a one."""
    words = printable(text)
    return f"'{words}" if words.lstrip().startswith(_FORMULA) and words != "-" else words


def key_cell(key: str) -> str:
    """Return what a platform finds a student by, unchanged.

    Raises:
        CannotSay: a spreadsheet would take it for a formula, and changed it would be another key.
    """
    if text_cell(key) != key or "\n" in key:
        raise CannotSay(
            f"{key!r} would be a formula in a spreadsheet, and is needed as it is: enter it by hand"
        )
    return key


def is_number(cell: str) -> bool:
    """Whether a cell holds a number as spreadsheets write it."""
    return re.fullmatch(r"\s*\d+(\.\d*)?\s*", cell) is not None


def _cell_value(cell: str) -> str:
    """What stands in a cell, without what keeps Excel from counting with it."""
    return cell.strip().removeprefix("'")


def _collected(student: str) -> tuple[str, str]:
    """Return the name and the platform's number of a student whom `course collect` called so; else "" twice."""
    match = re.fullmatch(r"(.+)-(\d+)", student)
    return (match[1], match[2]) if match else ("", "")


def _alike(one: str, other: str) -> bool:
    """Whether two ways to write a name have most of their letters in common, in any order."""
    first, second = ("".join(sorted(filter(str.isalnum, name.casefold()))) for name in (one, other))
    return SequenceMatcher(None, first, second).ratio() > 0.6
