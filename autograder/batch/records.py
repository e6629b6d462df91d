"""The file of grades that a batch writes."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from autograder.atomic_file import write_atomically
from autograder.engine.verdict import Grade

GRADES = "grades.json"


def write_grades(path: Path, grades: Sequence[Grade]) -> None:
    """Write the grades of a batch as one list, for the instructor: it includes the details of hidden checks."""
    write_atomically(path, json.dumps([grade.to_json() for grade in grades], indent=2) + "\n")


def read_grades(path: Path) -> list[Grade]:
    """Read back what `write_grades` wrote; no grades if there is no such file."""
    return [Grade.from_json(record) for record in json.loads(path.read_text())] if path.exists() else []
