"""The common output of the platforms' readers: students' files."""

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
        student: the name of their folder.
        name: the file's, as the student called it.
        file: where its content is.
        turn: order of hand-ins; of two files for the same exercise the one with the higher turn is used.
        exercise: if the platform names it.
        late: if the platform says so.
        timestamp: when it was handed in, as nbgrader writes it; "" if the platform does not say.
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
    """The files that a platform's reader found, and a sentence on each file that is unknown or not read."""

    files: list[HandedIn] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)

    def add(self, file: File, name: str, *student: str, **more: Any) -> None:
        """Add a file: its name, the words of its student's name, and fields of `HandedIn`; refuse unusable names."""
        try:
            self.files.append(HandedIn(student_name(*student), name, file, **more))
        except Refused as error:
            self.refused.append(f"{file.path}: {error}")


@dataclass(frozen=True)
class Assignment:
    """The instructor's options for a download: its exercise, and the platform's name for that; "" if not given."""

    exercise: str = ""
    slug: str = ""


def student_name(*words: str) -> str:
    """Return a name for a student's folder: the non-empty words joined by "-", without invalid characters.

    Raises:
        Refused: nothing usable is left.
    """
    joined = unicodedata.normalize("NFC", "-".join(word.strip() for word in words if word.strip()))
    name = re.sub(r"[^\w@+.,' -]", "_", joined).strip()
    if not STUDENT.fullmatch(name) or len(name) > MAX_NAME_LENGTH:
        raise Refused(f"{joined[:MAX_NAME_LENGTH]!r} cannot be the name of a student's folder")
    return name


def without_wrapper(download: Download, student: re.Pattern[str]) -> Iterator[tuple[File, tuple[str, ...]]]:
    """Yield each file with the parts of its path, without a top folder around everything, which unpacking creates.

    So a file's student is read from the platform's own folder, never from a folder that a student made below it.
    """
    tops = {file.path.parts[0] for file in download.files}
    wrapped = len(tops) == 1 and not student.fullmatch(min(tops)) and len(download.files[0].path.parts) > 1
    for file in download.files:
        yield file, file.path.parts[1:] if wrapped else file.path.parts
