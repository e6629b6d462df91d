"""The common output of the platforms' readers: the files that students handed in."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from autograder.classroom.batch.collection import STUDENT
from autograder.classroom.collect.download import Download, File, Refused

MAX_NAME_LENGTH = 100  # characters


@dataclass(frozen=True)
class HandedIn:
    """One file of one student.

    Attributes:
        student: the name of the student's folder.
        name: the file's name, as the student called it.
        file: the file in the download.
        turn: the order of hand-ins; of two files for the same exercise the one with the higher turn is used.
        exercise: the exercise, if the platform names it; else "".
        late: whether the platform marks the file as late.
        timestamp: when the file was handed in, as nbgrader writes it; "" if the platform does not say.
    """

    student: str
    name: str
    file: File
    turn: int = 0
    exercise: str = ""
    late: bool = False
    timestamp: str = ""


@dataclass
class Reading:
    """The files that a platform's reader found, and a sentence on each file that is unknown or refused."""

    files: list[HandedIn] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)

    def add(self, file: File, name: str, *student: str, **more: Any) -> None:
        """Add a student's file; `student`: the words of the student's name. Refuse it if they make no valid name."""
        try:
            self.files.append(HandedIn(student_name(*student), name, file, **more))
        except Refused as error:
            self.refused.append(f"{file.path}: {error}")


@dataclass(frozen=True)
class Assignment:
    """The instructor's options for a download: its exercise, and the platform's name for it; "" if not given."""

    exercise: str = ""
    slug: str = ""


def student_name(*words: str) -> str:
    """Return a name for a student's folder: the non-empty words joined by "-", without invalid characters.

    Raises:
        Refused: the result is not a valid name.
    """
    joined = unicodedata.normalize("NFC", "-".join(word.strip() for word in words if word.strip()))
    name = re.sub(r"[^\w@+.,' -]", "_", joined).strip()
    if not STUDENT.fullmatch(name) or len(name) > MAX_NAME_LENGTH:
        raise Refused(f"{joined[:MAX_NAME_LENGTH]!r} cannot be the name of a student's folder")
    return name


def without_wrapper(download: Download, student: re.Pattern[str]) -> Iterator[tuple[File, tuple[str, ...]]]:
    """Yield each file with the parts of its path, without the one top folder that unpacking may have created.

    The first part is then the platform's own folder, from which the student is read, and never a folder that the
    student made.
    """
    tops = {file.path.parts[0] for file in download.files}
    wrapped = len(tops) == 1 and not student.fullmatch(min(tops)) and len(download.files[0].path.parts) > 1
    for file in download.files:
        yield file, file.path.parts[1:] if wrapped else file.path.parts
