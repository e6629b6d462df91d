"""The file of grades that a batch writes."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from autograder.engine.verdict import Grade

GRADES = "grades.json"


def write_grades(path: Path, grades: Sequence[Grade]) -> None:
    """Write the grades of a batch as one list, for the instructor: it includes the details of hidden checks."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps([grade.to_json() for grade in grades], indent=2) + "\n")
