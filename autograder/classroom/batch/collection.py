"""Finds the submissions of a class, in nbgrader's layout or as plain files."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from nbgrader.utils import parse_utc

from autograder.engine.exercise import all_names, file_names
from autograder.engine.hand_in import Candidate, OwnFile, candidates_in, choose_work
from autograder.engine.submission import Submission, UnusableSubmission
from ros_runtime.course_error import CourseError

STUDENT = re.compile(r"[\w@+][\w@+.,' -]*")  # names that nbgrader, file systems and shells accept
_SECRET = re.compile("[0-9a-f]{128}")
MAX_LISTED_FILES = 5  # files listed for a student without a submission
LAYOUT = "SUBMITTED/<student>/<exercise>/<exercise>.ipynb or SUBMITTED/<student>/<exercise>.py"


class NoSubmissions(CourseError):
    """The folder has nothing that can be graded; the message says what layout is expected."""


@dataclass(frozen=True)
class Work:
    """One student's submission for one exercise; `candidates` is empty if its folder has no usable file."""

    student: str
    exercise: str
    candidates: tuple[Candidate, ...] = ()
    timestamp: str = ""  # as in the timestamp.txt of nbgrader's collect
    secret: str = ""  # from submission_secret.txt, which nbgrader needs to return feedback

    def read(self) -> Submission:
        """Read the submission; raises UnusableSubmission, which says what is wrong with it."""
        if not self.candidates:
            names = " nor ".join(file_names(self.exercise))
            raise UnusableSubmission(
                f"the folder {self.exercise} holds neither {self.exercise}.ipynb nor {names}"
            )
        sources = self._choice[0].sources
        if isinstance(sources, UnusableSubmission):
            raise sources
        return Submission(self.exercise, self.student, sources)

    @property
    def left_aside(self) -> list[str]:
        """A sentence on each file of this exercise that differs from the graded one and is not graded."""
        return [f"{self.student}: {line}" for line in self._choice[1]] if self.candidates else []

    @cached_property
    def _choice(self) -> tuple[Candidate, list[str]]:
        return choose_work(self.candidates)

    def files(self) -> list[Path]:
        """Return the files of all candidates; they are readable files on this machine."""
        files = (file for candidate in self.candidates for file in candidate.files.values())
        return [file.path for file in files if isinstance(file, OwnFile)]


@dataclass(frozen=True)
class Collection:
    """The submissions found, in order of student and exercise.

    `ignored` has sentences on other files and folders, `refused` on students' folders that cannot be used.
    """

    works: Sequence[Work]
    ignored: Sequence[str]
    refused: Sequence[str]


def collect(folder: Path) -> Collection:
    """Find all submissions in the folder; raises `NoSubmissions` when there is none."""
    if not folder.is_dir():
        raise NoSubmissions(f"{folder} is not a folder; expected {LAYOUT}")
    files = files_of_exercises()
    works: dict[tuple[str, str], Work] = {}
    ignored: list[str] = []
    without: list[str] = []
    refused: list[str] = []
    for student in _visible(folder):
        if not student.is_dir() or student.is_symlink():
            ignored.append(f"{student.name!r} is not a folder with a student's work")
        elif not STUDENT.fullmatch(student.name):
            refused.append(
                f"rename the folder {student.name!r}: only letters, digits and . , _ - @ + ' are allowed"
            )
        else:
            try:
                found = {(work.student, work.exercise): work for work in works_of(student, files)}
            except OSError as error:
                refused.append(f"the folder {student.name!r} cannot be read: {error.strerror}")
                continue
            works |= found
            if not found:
                there = ", ".join(path.name for path in _visible(student)[:MAX_LISTED_FILES]) or "nothing"
                without.append(f"{student.name} handed in none of the exercises; their folder holds {there}")
    if without:
        ignored += [*without, f"a file must have the name of an exercise: {', '.join(files)}"]
    if not works and not refused:
        raise NoSubmissions(f"found nothing to grade in {folder}; expected {LAYOUT}")
    return Collection([works[key] for key in sorted(works)], ignored, refused)


def files_of_exercises() -> Mapping[str, tuple[str, ...]]:
    """Return the names of each exercise's files."""
    return {exercise: file_names(exercise) for exercise in all_names()}


def works_of(student: Path, files: Mapping[str, tuple[str, ...]]) -> Iterator[Work]:
    """Yield the submissions in one student's folder; raises OSError if it cannot be read."""
    found = candidates_in(student, files)
    for exercise in files:
        folder = student / exercise
        if exercise in found or folder.is_dir():
            candidates = tuple(found.get(exercise, ()))
            yield Work(student.name, exercise, candidates, _timestamp(folder), _secret(folder))


def _visible(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if not path.name.startswith("."))


def _timestamp(folder: Path) -> str:
    """The time of submission from timestamp.txt, if nbgrader can parse it; otherwise ""."""
    try:
        text = _beginning(folder / "timestamp.txt").decode().strip()
        parse_utc(text)
    except Exception:  # a malformed date can raise many errors; a missing date costs no points
        return ""
    return text


def _secret(folder: Path) -> str:
    """The secret in submission_secret.txt if it has the format that `nbgrader submit` writes; otherwise ""."""
    try:
        text = _beginning(folder / "submission_secret.txt").decode()
    except (OSError, ValueError):
        return ""
    return text if _SECRET.fullmatch(text) else ""


def _beginning(path: Path) -> bytes:
    """The first bytes of a file; b"" for a link or anything else that is not a regular file."""
    if path.parent.is_symlink() or path.is_symlink() or not path.is_file():
        return b""
    with path.open("rb") as file:
        return file.read(200)
