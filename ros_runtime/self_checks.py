"""Stores the last self-check of each exercise for the student's progress page, and reads progress files."""

from __future__ import annotations

import contextlib
import json
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from ros_runtime.project import WORK

FILE = WORK / "exercises" / ".progress.json"  # not in an exercise's folder, because students submit that
KIND = "checks"


@dataclass(frozen=True)
class LastCheck:
    """The outcome of a self-check: visible checks passed, their total, the time (ISO 8601, local), the fingerprint."""

    passed: int
    total: int
    at: str
    program: str = ""


def last_checks(file: Path = FILE) -> dict[str, LastCheck]:
    """Return the last self-check of each exercise that has one; damaged entries are left out."""
    checks = {}
    for exercise, entry in entries_of(file, KIND).items():
        with contextlib.suppress(TypeError):
            checks[exercise] = LastCheck(**entry)
    return checks


def store_check(exercise: str, passed: int, total: int, program: str = "", file: Path = FILE) -> None:
    """Store a self-check of one of the course's exercises; does nothing if the file cannot be written."""
    if not (file.parent / exercise).is_dir():  # an exercise of another course
        return
    check = LastCheck(passed, total, datetime.now().isoformat(timespec="seconds"), program)
    entries = {**entries_of(file, KIND), exercise: asdict(check)}
    with contextlib.suppress(OSError):
        file.write_text(json.dumps({KIND: entries}, indent=1) + "\n", encoding="utf-8")


def entries_of(file: Path, kind: str) -> dict[str, Any]:
    """Return the entries of one kind in a progress file; {} if there are none, or the file is damaged."""
    entries = read_progress_file(file).get(kind)
    return entries if isinstance(entries, dict) else {}


def read_progress_file(file: Path) -> dict[str, Any]:
    """Return the content of a progress file; {} if there is no such file, or it is damaged."""
    try:
        kept = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return kept if isinstance(kept, dict) else {}
