"""A question about one student's program, with the key of each of its parts."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from markupsafe import Markup, escape
from pydantic import TypeAdapter

from autograder.atomic_file import write_atomically

LETTERS = "abcdefgh"  # of a question's parts


@dataclass(frozen=True)
class Part:
    """What the student is asked, and what a right answer says."""

    asked: str
    key: str


@dataclass(frozen=True)
class Question:
    """A question on a moment of a run, on the executor with its threads and groups, or on a change of one line.

    `line` is the line of the program that it is mainly about; `situation` is what happened, or what the program has.
    """

    kind: Literal["moment", "executor", "change"]
    line: int
    situation: str
    parts: tuple[Part, ...]

    def lettered(self, texts: Sequence[str]) -> list[str]:
        """Return texts on the parts, with "(a) ", "(b) " … in front if there are several."""
        return [
            f"({letter}) {text}" if texts[1:] else text for letter, text in zip(LETTERS, texts, strict=False)
        ]


@dataclass(frozen=True)
class Sheet:
    """The questions for one student about the text `program`; `note` says why there are none, or too few."""

    student: str
    exercise: str
    program: str = ""
    questions: tuple[Question, ...] = ()
    note: str = ""


def html_of(*texts: str) -> Markup:
    """Return a paragraph for each text that is not empty, in which what is between backticks is code."""
    paragraphs = (f"<p>{escape(' '.join(text.split()))}</p>" for text in texts if text)
    return Markup(re.sub("`(.*?)`", r"<code>\1</code>", "\n\n".join(paragraphs)))


_KEPT = TypeAdapter(tuple[str, Sheet])  # what the sheet depends on, and the sheet


def keep(path: Path, sheet: Sheet, made_for: str) -> None:
    """Write a finished sheet to a file, with what it depends on."""
    write_atomically(path, _KEPT.dump_json((made_for, sheet), indent=1))


def kept(path: Path, made_for: str) -> Sheet | None:
    """Read a finished sheet; None if there is none, if it is damaged, or if it depends on something else."""
    try:
        depends_on, sheet = _KEPT.validate_json(path.read_bytes())
    except (OSError, ValueError):
        return None
    return sheet if depends_on == made_for else None
