"""CSV tables for spreadsheets and gradebooks: written so that no cell becomes a formula, read with size limits."""

from __future__ import annotations

import codecs
import csv
import io
import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from pathlib import Path

from charset_normalizer import from_bytes

from autograder.classroom.export.published import CannotExpress, UnusableBatch, number, printable

MAX_ROSTER_BYTES = 20_000_000  # of a roster
# A first line that names the separator: Excel reads it, and some programs write it.
_SEPARATOR_LINE = re.compile(r"sep=([,;\t])\r?\n", re.IGNORECASE)
_WORKBOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")  # first bytes of workbooks, in the new and the old format
# First characters of a formula; some spreadsheets accept the full-width forms, too.
_FORMULA = tuple("=+-@＝＋－＠")


@dataclass(frozen=True)
class Table:
    """A heading and rows of the same length; `encoding` is "" for UTF-8 and UTF-16, else the guessed encoding."""

    heading: Sequence[str]
    rows: Sequence[Sequence[str]]
    encoding: str = ""

    def notes(self, path: Path | None) -> list[str]:
        """Return a sentence on the encoding if it had to be guessed."""
        if not self.encoding:
            return []
        return [
            f"{path} is not UTF-8 and was read as {self.encoding}: if a heading or a name is wrong in the files "
            "written, save the roster as “CSV UTF-8” and export again"
        ]

    def column(self, index: int) -> list[str]:
        """Return the cells of a column, without the spaces around them."""
        return [row[index].strip() for row in self.rows]

    def index(self, *names: str) -> int | None:
        """Return the first column that has one of these names, in any case; None if there is none."""
        lowered = [title.strip().lower() for title in self.heading]
        return next((lowered.index(name.lower()) for name in names if name.lower() in lowered), None)

    def row_of(
        self, student: str, columns: Iterable[int | None], numbers: int | None, names: Sequence[int | None]
    ) -> Sequence[str]:
        """Return the row in which one of the columns has the student's name.

        `course collect` appends the platform's number to a name. This number is looked up in the column `numbers`. The
        rest of the name must resemble the cell of the same row in a column of `names`, because any name may end in a
        number.

        Raises:
            CannotExpress: no row or more than one row matches, or the number belongs to another name.
        """
        wanted = [(column, student) for column in columns if column is not None]
        name, its_number = _collected(student)
        if its_number and numbers is not None:
            wanted.append((numbers, its_number))
        for column, value in wanted:
            found = [row for row in self.rows if _cell_value(row[column]) == value]
            if len(found) > 1:
                raise CannotExpress(
                    f"{value} is in {len(found)} rows of the roster, column {self.heading[column]}"
                )
            called = [found[0][column] for column in names if column is not None] if found else []
            if called and value != student and not any(_are_similar(name, one) for one in called):
                raise CannotExpress(
                    f"number {value} belongs to {called[0]} in the roster: enter the grade by hand"
                )
            if found:
                return found[0]
        looked_in = ", ".join(dict.fromkeys(self.heading[column] for column, _ in wanted))
        raise CannotExpress(f"the roster has no such student (searched columns: {looked_in})")


def read_table(path: Path) -> Table:
    """Read a CSV file that a platform exported.

    Raises:
        UnusableBatch: the file is not a CSV file, is empty or too large, or cannot be read.
    """
    try:
        if path.stat().st_size > MAX_ROSTER_BYTES:
            raise UnusableBatch(
                f"{path} has more than {MAX_ROSTER_BYTES // 1_000_000} MB; expected a table of a class"
            )
        content = path.read_bytes()
        if content.startswith(_WORKBOOKS):
            raise UnusableBatch(
                f"{path} is a workbook of a spreadsheet program: open it and save it as “CSV UTF-8”"
            )
        text, encoding = _decoded(content)
    except (OSError, UnicodeDecodeError) as error:
        raise UnusableBatch(f"{path} cannot be read: {error}") from error
    separator = _SEPARATOR_LINE.match(text)
    text = text[separator.end() :] if separator else text
    try:
        delimiter = (
            separator[1] if separator else max(",;\t", key=lambda one: len(next(_cells(text, one), [])))
        )
        lines = [line for line in _cells(text, delimiter) if any(map(str.strip, line))]
    except csv.Error as error:
        raise UnusableBatch(f"{path} is not a CSV file: {error}") from error
    if not lines:
        raise UnusableBatch(f"{path} is empty; expected a heading and a row for each student")
    width = len(lines[0])
    return Table(lines[0], [(line + [""] * width)[:width] for line in lines[1:]], encoding)


def _cells(text: str, delimiter: str) -> Iterator[list[str]]:
    return csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)


def _decoded(content: bytes) -> tuple[str, str]:
    """Return the text, and the guessed encoding if it is neither UTF-8 nor UTF-16.

    Platforms write UTF-8, and Excel's “Unicode Text” is UTF-16; its plain CSV uses the code page of the user's
    language. The guess works for scripts other than Latin; for Latin, Western European is assumed.
    """
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return content.decode("utf-16"), ""
    if 0 in content[:2]:  # UTF-16 without a byte order mark
        return content.decode("utf-16-be" if content[0] == 0 else "utf-16-le"), ""
    try:
        return content.decode("utf-8-sig"), ""
    except UnicodeDecodeError:
        guess = from_bytes(content).best()
    if guess and any(one.isalpha() and "LATIN" not in unicodedata.name(one, "") for one in str(guess)):
        return str(guess), guess.encoding
    return content.decode("cp1252", errors="replace"), "cp1252"


def csv_text(heading: Sequence[str], rows: Iterable[Sequence[str | float]]) -> str:
    """Return a CSV file's content; each cell must be a number or come from `text_cell` or `key_cell`."""
    file = io.StringIO(newline="")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(heading)
    writer.writerows([[cell if isinstance(cell, str) else number(cell) for cell in row] for row in rows])
    return file.getvalue()


def text_cell(text: str) -> str:
    """Return the text, with an apostrophe in front if a spreadsheet would read it as a formula."""
    words = printable(text)
    return f"'{words}" if words.lstrip().startswith(_FORMULA) and words != "-" else words


def key_cell(key: str) -> str:
    """Return the key by which a platform finds a student, unchanged.

    Raises:
        CannotExpress: a spreadsheet would read the key as a formula, and a changed key would not match.
    """
    if text_cell(key) != key or "\n" in key:
        raise CannotExpress(
            f"{key!r} would be a formula in a spreadsheet, and must not be changed: enter the grade by hand"
        )
    return key


def read_number(cell: str) -> float | None:
    """Return the number in a cell, in any language's notation, such as 1.000,50 or 1,000.50; None if there is none.

    As in Canvas' import, the last comma or point is the decimal separator.
    """
    digits = re.sub(r"[\s'’]", "", cell).replace("٫", ",")
    if not re.fullmatch(r"\d+([.,]\d*)*", digits):
        return None
    *whole, last = re.split("[.,]", digits)
    return float(f"{''.join(whole)}.{last}" if whole else last)


def _cell_value(cell: str) -> str:
    """Return the text of a cell, without the apostrophe that makes Excel treat the cell as text."""
    return cell.strip().removeprefix("'")


def _collected(student: str) -> tuple[str, str]:
    """Split a name that `course collect` made into the student's name and the platform's number; else ("", "")."""
    match = re.fullmatch(r"(.+)-(\d+)", student)
    return (match[1], match[2]) if match else ("", "")


def _are_similar(one: str, other: str) -> bool:
    """Whether two spellings of a name share most of their letters, in any order."""
    first, second = ("".join(sorted(filter(str.isalnum, name.casefold()))) for name in (one, other))
    return SequenceMatcher(None, first, second).ratio() > 0.6
