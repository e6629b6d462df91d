"""During a session in the lab: a student can show the instructor's page where the last self-check failed."""

from __future__ import annotations

import getpass
import hashlib
import os
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from autograder.atomic_file import write_atomically
from autograder.engine.verdict import Grade
from ros_runtime.course_error import CourseError

VARIABLE = "COURSE_LAB_HOUR"  # names the folder that a class shares, owned by the instructor
MAX_AGE = 4 * 3600.0  # s; older entries are of another session
MAX_BYTES = 4000  # of an entry


class CannotShare(CourseError):
    """Nothing can be shared; the message says why."""


class Shared(BaseModel):
    """What a student shares.

    Attributes:
        check: title of the first check that failed; "" if all visible checks passed.
        place: a word by which the instructor finds the student, such as "row 3"; "" if none was given.
        since: s since 1970, when this check was shared as the first that failed.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    exercise: str = Field(max_length=100)
    check: str = Field(max_length=300)
    passed: int
    total: int
    place: str = Field(max_length=60)
    since: float


def share(grade: Grade, place: str = "") -> str:
    """Write what a self-check found to the class's folder; return a sentence that says what is shared.

    Raises:
        CannotShare: the class has no shared folder, or it cannot be written.
    """
    path = _own_entry()
    first = next((check.title for check in grade.checks if check.status != "passed"), "")
    before = _read(path)
    is_same = before and (before.exercise, before.check) == (grade.exercise, first)
    shared = Shared(
        exercise=grade.exercise,
        check=first[:300],
        passed=sum(check.status == "passed" for check in grade.checks),
        total=len(grade.checks),
        place=place[:60],
        since=before.since if before and is_same else time.time(),
    )
    try:
        write_atomically(path, shared.model_dump_json())
        path.chmod(0o644)
    except OSError as error:
        raise CannotShare(f"{path.parent} cannot be written: {error.strerror}") from error
    return (
        f"Your instructor's page shows: {grade.exercise}, {shared.passed} of {shared.total} checks passed, "
        f"first failed check: {first or 'none'}{f', {place}' if place else ''}. It has neither your name nor your "
        "program. `checked.unshare()` removes it; it is removed by itself after four hours."
    )


def unshare() -> str:
    """Remove what this student shares."""
    _own_entry().unlink(missing_ok=True)
    return "Your instructor's page shows nothing of you any more."


@dataclass(frozen=True)
class Group:
    """The students whose first failed check is the same; `minutes` and `places` are in the order of their waiting."""

    exercise: str
    check: str
    minutes: list[int]
    places: list[str]


def groups(folder: Path, now: float) -> list[Group]:
    """Read all entries of a class, and delete old ones; groups in which students wait longest come first.

    Of groups that wait equally long, the one with more students comes first.

    Students write the entries, so anything that is not an entry is ignored.
    """
    found: dict[tuple[str, str], list[Shared]] = {}
    for path, shared in _entries(folder):
        if now - path.lstat().st_mtime > MAX_AGE:
            path.unlink(missing_ok=True)
        else:
            found.setdefault((shared.exercise, shared.check), []).append(shared)
    made = []
    for (exercise, check), theirs in found.items():
        theirs.sort(key=lambda one: one.since)
        minutes = [max(0, int((now - one.since) // 60)) for one in theirs]
        made.append(Group(exercise, check, minutes, [one.place for one in theirs if one.place]))
    return sorted(made, key=_urgency)


def _urgency(group: Group) -> tuple[bool, int, int, str, str]:
    return not group.check, -group.minutes[0], -len(group.minutes), group.exercise, group.check


def _entries(folder: Path) -> Iterator[tuple[Path, Shared]]:
    for path in sorted(folder.glob("*.json")):
        if shared := _read(path):
            yield path, shared


def _read(path: Path) -> Shared | None:
    """Return an entry; None if there is none, or something else."""
    try:
        if path.is_symlink() or not path.is_file() or path.stat().st_size > MAX_BYTES:
            return None
        return Shared.model_validate_json(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, ValidationError):
        return None


def _own_entry() -> Path:
    folder = os.environ.get(VARIABLE, "")
    if not folder or not Path(folder).is_dir():
        raise CannotShare(f"your class has no folder for this: {VARIABLE} names {folder or 'nothing'}")
    owner = hashlib.sha256(f"{folder}\0{getpass.getuser()}".encode()).hexdigest()[:16]
    return Path(folder, f"{owner}.json")
