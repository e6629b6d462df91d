"""All formats by name, and the export itself: the files it makes, and the submissions it leaves out."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from itertools import groupby
from pathlib import Path
from typing import Any

from autograder.atomic_file import write_atomically
from autograder.classroom.batch.records import GRADES
from autograder.classroom.export import canvas, classroom50, grades_csv, gradescope, junit, moodle
from autograder.classroom.export.published import (
    CannotSay,
    Options,
    Published,
    UnusableBatch,
    publish,
    require_safe_names,
    why_no_score,
)
from autograder.engine.verdict import Grade

PER_SUBMISSION: Mapping[str, Any] = {
    "gradescope": gradescope,
    "classroom50": classroom50,
    "junit": junit,
}
_Tables = tuple[dict[str, str], list["LeftOut"], list[str]]  # files, what is not in them, notes
FORMATS = ("gradescope", "canvas", "moodle", "classroom50", "junit", "csv")


@dataclass(frozen=True)
class LeftOut:
    """A submission that is left out of the export; `has_score`: its grade has a score, which the format cannot hold."""

    student: str
    exercise: str
    why: str
    has_score: bool


@dataclass(frozen=True)
class Export:
    """The result of an export: the content of each file by its path in the folder, and the submissions left out.

    `places` are all paths that these grades could have produced; other files of an earlier export there are outdated.
    `notes` warn of unintended effects on the platform.
    """

    files: Mapping[str, str]
    left_out: Sequence[LeftOut]
    places: Sequence[str]
    notes: Sequence[str] = ()

    def write(self, out: Path) -> None:
        """Write each file atomically, and remove outdated files of an earlier export."""
        for name in self.places:
            if name not in self.files:
                (out / name).unlink(missing_ok=True)
        for name, text in self.files.items():
            write_atomically(out / name, text)


def export(name: str, grades: Sequence[Grade], options: Options) -> Export:
    """Make the files of a format.

    Raises:
        UnusableBatch: the grades or the options cannot be used.
    """
    require_safe_names(grades)
    if name in PER_SUBMISSION:
        return _each(PER_SUBMISSION[name], grades, options)
    scored = [publish(grade, options.hidden) for grade in grades if not why_no_score(grade)]
    without = [
        LeftOut(grade.student, grade.exercise, why_no_score(grade), False)
        for grade in grades
        if why_no_score(grade)
    ]
    if name == "csv":
        rows = [grades_csv.row_of(published) for published in scored]
        return Export({grades_csv.FILE: grades_csv.table_text(rows)}, without, [grades_csv.FILE])
    exercises = sorted({grade.exercise for grade in grades})
    tables = _canvas_tables if name == "canvas" else _moodle_tables
    files, unknown, notes = tables(scored, options)
    return Export(files, [*without, *unknown], [_table_file(exercise) for exercise in exercises], notes)


def _each(writer: Any, grades: Sequence[Grade], options: Options) -> Export:
    """Make a file for each submission; for one without a score only if the format can express that."""
    files: dict[str, str] = {}
    left_out: list[LeftOut] = []
    for grade in grades:
        why = why_no_score(grade)
        try:
            files[_place(writer, grade)] = writer.render(grade, options)
        except CannotSay as error:
            why = why or str(error)
        if why:
            left_out.append(LeftOut(grade.student, grade.exercise, why, not why_no_score(grade)))
    notes = writer.notes(options) if hasattr(writer, "notes") else []
    return Export(files, left_out, [_place(writer, grade) for grade in grades], notes)


def _place(writer: Any, grade: Grade) -> str:
    return f"{grade.student}/{grade.exercise}/{writer.FILE}"


def _canvas_tables(scored: Sequence[Published], options: Options) -> _Tables:
    files: dict[str, str] = {}
    left_out: list[LeftOut] = []
    by_exercise = dict(_by_exercise(scored))
    gradebook = canvas.open_gradebook(options, list(by_exercise))
    for exercise, group in by_exercise.items():
        rows, unknown = _rows(group, lambda published: canvas.cells_of(gradebook, published))
        left_out += unknown
        if rows:
            files[_table_file(exercise)] = canvas.table_text(gradebook, exercise, group[0].max_score, rows)
    return files, left_out, gradebook.notes(options)


def _moodle_tables(scored: Sequence[Published], options: Options) -> _Tables:
    files: dict[str, str] = {}
    left_out: list[LeftOut] = []
    class_list = moodle.open_class(options, [published.student for published in scored])
    for exercise, group in _by_exercise(scored):
        rows, unknown = _rows(group, lambda published: moodle.cells_of(class_list, published))
        left_out += unknown
        if rows:
            files[_table_file(exercise)] = moodle.table_text(class_list, exercise, rows)
    return files, left_out, class_list.notes(options)


def _rows(
    group: Sequence[Published], cells: Callable[[Published], list[str | float]]
) -> tuple[list[list[str | float]], list[LeftOut]]:
    rows: list[list[str | float]] = []
    left_out: list[LeftOut] = []
    for published in group:
        try:
            rows.append(cells(published))
        except CannotSay as error:
            left_out.append(LeftOut(published.student, published.exercise, str(error), True))
    return rows, left_out


def _by_exercise(scored: Sequence[Published]) -> Iterator[tuple[str, list[Published]]]:
    in_order = sorted(scored, key=lambda published: (published.exercise, published.student))
    for exercise, group in groupby(in_order, key=lambda published: published.exercise):
        yield exercise, list(group)


def _table_file(exercise: str) -> str:
    return f"{exercise}.csv"


def read_batch(source: Path) -> tuple[Sequence[Grade], datetime]:
    """Return the grades in a folder's grades.json, or in the JSON file given, and when they were written.

    Raises:
        UnusableBatch: there are none, or the file is another one.
    """
    path = source / GRADES if source.is_dir() or source.suffix != ".json" else source
    try:
        records = json.loads(path.read_text(encoding="utf-8"))
        grades = [Grade.from_json(record) for record in (records if isinstance(records, list) else [records])]
        written = datetime.fromtimestamp(path.stat().st_mtime, timezone.utc)
    except FileNotFoundError as error:
        raise UnusableBatch(
            f"there is no {path}; grade first (./course grade SUBMITTED --out {path.parent}), or name the folder: "
            "--from FOLDER"
        ) from error
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise UnusableBatch(
            f"{path} does not hold the grades of a batch: {type(error).__name__}: {error}"
        ) from error
    if not grades:
        raise UnusableBatch(f"{path} has no grades; expected those of at least one submission")
    return grades, written
