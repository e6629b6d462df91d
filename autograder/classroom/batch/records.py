"""Reads and writes the file of a batch's grades."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from autograder.atomic_file import write_atomically
from autograder.engine.verdict import Grade
from ros_runtime.course_error import CourseError

GRADES = "grades.json"
UNREADABLE = (OSError, ValueError, RecursionError)  # raised for damaged or deeply nested JSON


def write_grades(path: Path, grades: Sequence[Grade]) -> None:
    """Write the grades of a batch as one list, for the instructor: it includes the details of hidden checks."""
    write_atomically(path, json.dumps([grade.to_json() for grade in grades], indent=2) + "\n")


def read_grades(path: Path) -> list[Grade]:
    """Read back what `write_grades` wrote; no grades if there is no such file.

    Raises:
        CourseError: the file holds something else.
    """
    if not path.exists():
        return []
    try:
        records = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(records, list):
            raise ValueError("it does not hold a list of grades")
        return [Grade.from_json(record) for record in records]
    except UNREADABLE as error:
        raise CourseError(
            f"{path} is not a file of grades ({str(error)[:500]}); restore the file of the last batch, or move this "
            "file away and grade the whole class again with --resume"
        ) from error
