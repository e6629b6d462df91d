"""All export formats by name, and the function that exports grades in one of them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from itertools import groupby
from pathlib import Path
from typing import Any

from autograder.atomic_file import write_atomically
from autograder.classroom.batch.records import GRADES, UNREADABLE
from autograder.classroom.export import canvas, classroom50, grades_csv, gradescope, junit, moodle
from autograder.classroom.export.published import (
    CannotExpress,
    Options,
    Published,
    UnusableBatch,
    publish,
    require_safe_names,
    why_no_score,
)
from autograder.engine.verdict import Grade

PER_SUBMISSION: Mapping[str, Any] = {"gradescope": gradescope, "classroom50": classroom50, "junit": junit}
PER_EXERCISE: Mapping[str, Any] = {"canvas": canvas, "moodle": moodle}
FORMATS = ("gradescope", "canvas", "moodle", "classroom50", "junit", "csv")


@dataclass(frozen=True)
class LeftOut:
    """A submission that is left out of the export; `has_score`: it has a score that the format cannot express."""

    student: str
    exercise: str
    why: str
    has_score: bool


@dataclass(frozen=True)
class Export:
    """The result of an export: the content of each file by its path in the folder, and the submissions left out.

    `places` are the paths of all files that these grades could produce; those not in `files` are outdated. `notes` warn
    of unintended effects on the platform.
    """

    files: Mapping[str, str | bytes]
    left_out: Sequence[LeftOut]
    places: Sequence[str]
    notes: Sequence[str] = ()

    def write(self, out: Path) -> None:
        """Write each file atomically, and remove the outdated files of an earlier export."""
        for name in self.places:
            if name not in self.files:
                (out / name).unlink(missing_ok=True)
        for name, content in self.files.items():
            write_atomically(out / name, content)


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
        LeftOut(grade.student, grade.exercise, why, False) for grade in grades if (why := why_no_score(grade))
    ]
    if name == "csv":
        rows = [grades_csv.row_of(published) for published in scored]
        return Export({grades_csv.FILE: grades_csv.table_text(rows)}, without, [grades_csv.FILE])
    exercises = sorted({grade.exercise for grade in grades})
    places = [
        name for exercise in exercises for name in (_table_file(exercise), moodle.feedback_file(exercise))
    ]
    files, unknown, notes = _tables(PER_EXERCISE[name], scored, options)
    return Export(files, [*without, *unknown], places, notes)


def _each(writer: Any, grades: Sequence[Grade], options: Options) -> Export:
    """Make a file for each submission; for a submission without a score only if the format can express that."""
    files: dict[str, str] = {}
    left_out: list[LeftOut] = []
    for grade in grades:
        why = why_no_score(grade)
        try:
            files[_place(writer, grade)] = writer.render(grade, options)
        except CannotExpress as error:
            why = why or str(error)
        if why:
            left_out.append(LeftOut(grade.student, grade.exercise, why, not why_no_score(grade)))
    notes = writer.notes(options) if hasattr(writer, "notes") else []
    return Export(files, left_out, [_place(writer, grade) for grade in grades], notes)


def _place(writer: Any, grade: Grade) -> str:
    return f"{grade.student}/{grade.exercise}/{writer.FILE}"


def _tables(
    platform: Any, scored: Sequence[Published], options: Options
) -> tuple[dict[str, str | bytes], list[LeftOut], list[str]]:
    """Make each exercise's table, and Moodle's feedback files; return them, the submissions left out, and notes."""
    files: dict[str, str | bytes] = {}
    left_out: list[LeftOut] = []
    class_list = platform.open_class(options, scored)
    in_order = sorted(scored, key=lambda published: (published.exercise, published.student))
    for exercise, group in groupby(in_order, key=lambda published: published.exercise):
        rows = {}  # by student
        for published in group:
            try:
                rows[published.student] = class_list.cells(published)
            except CannotExpress as error:
                left_out.append(LeftOut(published.student, exercise, str(error), True))
        if rows:
            files[_table_file(exercise)] = class_list.text(exercise, published.max_score, list(rows.values()))
        if platform is moodle and (archive := class_list.feedback_zip(exercise, rows)):
            files[moodle.feedback_file(exercise)] = archive
    return files, left_out, class_list.notes(options)


def _table_file(exercise: str) -> str:
    return f"{exercise}.csv"


def read_batch(source: Path) -> tuple[Sequence[Grade], datetime]:
    """Return the grades in a folder's grades.json, or in the JSON file given, and when they were written.

    Raises:
        UnusableBatch: the file is missing, has no grades, or holds something else.
    """
    path = source / GRADES if source.is_dir() or source.suffix != ".json" else source
    try:
        records = json.loads(path.read_text(encoding="utf-8"))
        grades = [Grade.from_json(record) for record in (records if isinstance(records, list) else [records])]
        written = datetime.fromtimestamp(path.stat().st_mtime, timezone.utc)
    except FileNotFoundError as error:
        raise UnusableBatch(
            f"there is no {path}; grade first (./course grade SUBMITTED --out {path.parent}), or give the folder of "
            "the grades: --from FOLDER"
        ) from error
    except UNREADABLE as error:
        raise UnusableBatch(
            f"{path} does not hold the grades of a batch: {type(error).__name__}: {error}"
        ) from error
    if not grades:
        raise UnusableBatch(f"{path} has no grades; expected the grade of at least one submission")
    return grades, written
