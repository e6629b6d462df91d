"""What a batch leaves behind for people and for other programs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from autograder.engine.verdict import Grade

GRADES = "grades.json"


def write_grades(path: Path, grades: Sequence[Grade]) -> None:
    """Write a batch as one list, for the instructor: with everything that hidden checks have seen."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps([grade.to_json() for grade in grades], indent=2) + "\n")
