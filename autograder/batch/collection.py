"""Finds the submissions of a class, in nbgrader's layout or as plain files."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from nbgrader.utils import parse_utc

from autograder.engine.exercise import all_names, file_names
from autograder.engine.submission import Submission, UnusableSubmission, read_submission

STUDENT = re.compile(r"[\w@+][\w@+.,' -]*")  # what nbgrader, a file system and a shell all take as a name
_SECRET = re.compile("[0-9a-f]{128}")
LAYOUT = "SUBMITTED/<student>/<exercise>/<exercise>.ipynb or SUBMITTED/<student>/<exercise>.py"


class NoSubmissions(Exception):
    """The folder has nothing that can be graded; the message says what layout is expected."""


@dataclass(frozen=True)
class Work:
    """One student's submission for one exercise; `path` is None when their folder has no file of that name."""

    student: str
    exercise: str
    path: Path | None
    timestamp: str = ""  # as in the timestamp.txt of nbgrader's collect
    secret: str = ""  # as in its submission_secret.txt, by which feedback finds its way back

    def read(self) -> Submission:
        """Read the submission; raises UnusableSubmission, which says what is wrong with it."""
        if self.path is None:
            names = " nor ".join(file_names(self.exercise))
            raise UnusableSubmission(
                f"the folder {self.exercise} holds neither {self.exercise}.ipynb nor {names}"
            )
        if any(path.is_symlink() or not path.is_file() for path in self.files()):
            raise UnusableSubmission(f"{self.path.name} is not an ordinary file")
        if self.path.parent.is_symlink():
            raise UnusableSubmission(
                f"the folder {self.path.parent.name} is a link; hand in the folder itself, with the files in it"
            )
        try:
            submission = read_submission(self.path, self.exercise, self.student)
        except UnusableSubmission as error:
            # Students read this, and the instructor's folders are not their business.
            raise UnusableSubmission(str(error).replace(str(self.path), self.path.name)) from error
        try:
            "".join(submission.sources.values()).encode()
        except UnicodeEncodeError as error:
            raise UnusableSubmission(
                f"{self.path.name} holds characters that no text can: {error.reason}"
            ) from error
        return submission

    def files(self) -> list[Path]:
        """Return the files that would be read."""
        if self.path is None:
            return []
        names = file_names(self.exercise)
        is_their_folder = len(names) > 1 and self.path.suffix != ".ipynb" and self.path.is_dir()
        if self.path.is_symlink() or not is_their_folder:
            return [self.path]
        return [place for name in names if _is_there(place := self.path / name)]


@dataclass(frozen=True)
class Collection:
    """The submissions found, in order of student and exercise.

    `ignored` lists what else is in the folder, `refused` the student folders with unusable names, as sentences.
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
    refused: list[str] = []
    for student in _visible(folder):
        if not student.is_dir() or student.is_symlink():
            ignored.append(f"{student.name!r} is not a folder with a student's work")
        elif not STUDENT.fullmatch(student.name):
            refused.append(
                f"the folder {student.name!r}: rename it to letters, digits and . , _ - @ + ' only"
            )
        else:
            try:
                found = list(works_of(student, files))
            except OSError as error:
                refused.append(f"the folder {student.name!r} cannot be read: {error.strerror}")
                continue
            if not found:
                ignored.append(f"{student.name} handed in none of {', '.join(files)}")
            works |= {(work.student, work.exercise): work for work in found}
    if not works and not refused:
        raise NoSubmissions(f"found nothing to grade in {folder}; expected {LAYOUT}")
    return Collection([works[key] for key in sorted(works)], ignored, refused)


def files_of_exercises() -> Mapping[str, tuple[str, ...]]:
    """Return the names of each exercise's files."""
    return {exercise: file_names(exercise) for exercise in all_names()}


def works_of(student: Path, files: Mapping[str, tuple[str, ...]]) -> Iterator[Work]:
    """Yield what one student's folder holds, by exercise.

    A folder for the exercise comes before a file beside it, and a notebook before the file it writes when run.
    """
    for exercise, names in files.items():
        folder = student / exercise
        home = folder if folder.is_dir() else student
        path = next((place for place in _places(home, exercise, names) if _is_there(place)), None)
        if path is not None or folder.is_dir():
            yield Work(student.name, exercise, path, _timestamp(folder), _secret(folder))


def _places(folder: Path, exercise: str, names: tuple[str, ...]) -> list[Path]:
    """Where a submission may be: the notebook, then the program, or the folder of an exercise with several files."""
    written = [folder / name for name in names]
    if len(names) > 1:
        written = [folder] if any(map(_is_there, written)) else []
    return [folder / f"{exercise}.ipynb", *written]


def _is_there(path: Path) -> bool:
    return path.exists() or path.is_symlink()


def _visible(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if not path.name.startswith("."))


def _timestamp(folder: Path) -> str:
    """The time of submission from timestamp.txt, if nbgrader can parse it; otherwise ""."""
    try:
        text = _beginning(folder / "timestamp.txt").decode().strip()
        parse_utc(text)
    except Exception:  # a date can be malformed in many ways, and a wrong one costs nobody points
        return ""
    return text


def _secret(folder: Path) -> str:
    """What nbgrader's submit has written into submission_secret.txt, if it is of that kind; otherwise ""."""
    try:
        text = _beginning(folder / "submission_secret.txt").decode()
    except (OSError, ValueError):
        return ""
    return text if _SECRET.fullmatch(text) else ""


def _beginning(path: Path) -> bytes:
    """The first bytes of a small file; none when it is no ordinary one."""
    if path.parent.is_symlink() or path.is_symlink() or not path.is_file():
        return b""
    with path.open("rb") as file:
        return file.read(200)
