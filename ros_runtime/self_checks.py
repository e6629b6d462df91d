"""Stores the last self-check of each exercise for the student's progress page; nothing else reads it."""

from __future__ import annotations

import contextlib
import json
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path

from ros_runtime.project import WORK

FILE = (
    WORK / "exercises" / ".progress.json"
)  # not in an exercise's folder, so that it is not handed in with it
KIND = "checks"


@dataclass(frozen=True)
class LastCheck:
    """How a self-check ended: visible checks passed, of how many, and when (ISO 8601, local time)."""

    passed: int
    total: int
    at: str


def last_checks(file: Path = FILE) -> dict[str, LastCheck]:
    """Return the last self-check of each exercise that was checked; damaged entries are left out."""
    checks = {}
    for exercise, entry in _entries(file).items():
        with contextlib.suppress(TypeError):
            checks[exercise] = LastCheck(**entry)
    return checks


def keep_check(exercise: str, passed: int, total: int, file: Path = FILE) -> None:
    """Store a self-check of one of the course's exercises; does nothing if the file cannot be written."""
    if not (file.parent / exercise).is_dir():  # an exercise of another course
        return
    check = LastCheck(passed, total, datetime.now().isoformat(timespec="seconds"))
    entries = {**_entries(file), exercise: asdict(check)}
    with contextlib.suppress(OSError):
        file.write_text(json.dumps({KIND: entries}, indent=1) + "\n", encoding="utf-8")


def _entries(file: Path) -> dict[str, dict]:
    try:
        kept = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    entries = kept.get(KIND) if isinstance(kept, dict) else None
    return entries if isinstance(entries, dict) else {}
