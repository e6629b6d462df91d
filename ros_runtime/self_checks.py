"""Stores the last self-check of each exercise, and what `course submit` wrote, and reads progress files."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from ros_runtime.project import WORK

FILE = WORK / "exercises" / ".progress.json"  # not in an exercise's folder, because students submit that
KIND = "checks"
PROGRAMS = "programs"  # the last self-check of each program, by its fingerprint
SUBMITTED = "submitted"  # SHA-256 of each file that `course submit` wrote, by its path from here


@dataclass(frozen=True)
class LastCheck:
    """The outcome of a self-check: visible checks passed, their total, the time (ISO 8601, local), the fingerprint."""

    passed: int
    total: int
    at: str
    program: str = ""


def last_checks(file: Path = FILE) -> dict[str, LastCheck]:
    """Return the last self-check of each exercise that has one; damaged entries are left out."""
    return _stored(file, KIND)


def last_check_of(program: str, file: Path = FILE) -> LastCheck | None:
    """Return the last self-check of the program with this fingerprint; None if there is none."""
    return _stored(file, PROGRAMS).get(program)


def _stored(file: Path, kind: str) -> dict[str, LastCheck]:
    checks = {}
    for key, entry in entries_of(file, kind).items():
        with contextlib.suppress(TypeError):
            checks[key] = LastCheck(**entry)
    return checks


def store_check(
    exercise: str, passed: int, total: int, program: str = "", file: Path = FILE, *, for_its_row: bool = True
) -> None:
    """Store a self-check of one of the course's exercises; does nothing if the file cannot be written.

    Unless `for_its_row`, it is stored for the program alone, and not as the last check of the exercise.
    """
    if not (file.parent / exercise).is_dir():  # an exercise of another course
        return
    check = asdict(LastCheck(passed, total, datetime.now().isoformat(timespec="seconds"), program))
    _store(
        file,
        {KIND: {exercise: check} if for_its_row else {}, PROGRAMS: {program: check} if program else {}},
    )


def submitted_folders(file: Path = FILE) -> dict[str, str]:
    """Return for each exercise with an unchanged submitted file the file's folder, relative to the course."""
    written = [(file.parent / path, digest) for path, digest in entries_of(file, SUBMITTED).items()]
    same = [place for place, digest in written if place.is_file() and _digest(place) == digest]
    return {place.stem: os.path.relpath(place.parent, file.parent.parent) for place in same}


def was_submitted(path: Path, file: Path = FILE) -> bool:
    """Return whether `course submit` wrote a file as it is now."""
    return entries_of(file, SUBMITTED).get(_from_here(path, file)) == _digest(path)


def store_submitted(path: Path, file: Path = FILE) -> None:
    """Store that `course submit` wrote a file; does nothing if that cannot be stored."""
    _store(file, {SUBMITTED: {_from_here(path, file): _digest(path)}})


def _from_here(path: Path, file: Path) -> str:
    return os.path.relpath(path.resolve(), file.parent.resolve())


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _store(file: Path, entries: dict[str, dict[str, Any]]) -> None:
    content = read_progress_file(file)
    content |= {kind: entries_of(file, kind) | new for kind, new in entries.items() if new}
    with contextlib.suppress(OSError):
        file.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


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
