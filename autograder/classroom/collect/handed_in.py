"""What a student handed in, as every platform's reader says it."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, field

from autograder.classroom.batch.collection import STUDENT
from autograder.classroom.collect.download import Download, File, Refused

LONGEST_NAME = 100  # characters


@dataclass(frozen=True)
class HandedIn:
    """One file of one student.

    Attributes:
        student: the name of their folder.
        name: the file's, as the student called it.
        file: where its content is.
        turn: of two files for the same exercise the one with the higher turn counts.
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
    """What a platform's reader found, and a sentence for each file that is not one of its own or not read."""

    files: list[HandedIn] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Assignment:
    """What the instructor says of a download: its exercise, and what the platform calls that, if they do."""

    exercise: str = ""
    slug: str = ""


def student_name(*words: str) -> str:
    """Return a name for a student's folder: the words, if not empty, joined by "-", without what it cannot have.

    Raises:
        Refused: nothing usable is left.
    """
    joined = unicodedata.normalize("NFC", "-".join(word.strip() for word in words if word.strip()))
    name = re.sub(r"[^\w@+.,' -]", "_", joined).strip()
    if not STUDENT.fullmatch(name) or len(name) > LONGEST_NAME:
        raise Refused(f"{joined[:LONGEST_NAME]!r} cannot be the name of a student's folder")
    return name


def without_wrapper(download: Download, student: re.Pattern[str]) -> Iterator[tuple[File, tuple[str, ...]]]:
    """Yield each file with the parts of its path; a folder around everything, which unpacking makes, is left out.

    So only the platform's own folder, and none that a student has made below it, says whose a file is.
    """
    tops = {file.path.parts[0] for file in download.files}
    wrapped = len(tops) == 1 and not student.fullmatch(min(tops)) and len(download.files[0].path.parts) > 1
    for file in download.files:
        yield file, file.path.parts[1:] if wrapped else file.path.parts
