"""A question about one student's program, with the key of each of its parts."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Literal

from markupsafe import Markup, escape

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
    return Markup("\n\n").join(Markup("<p>{}</p>").format(_with_code(text)) for text in texts if text)


def _with_code(text: str) -> Markup:
    pieces = enumerate(" ".join(text.split()).split("`"))
    return Markup("").join(
        Markup("<code>{}</code>").format(one) if place % 2 else escape(one) for place, one in pieces
    )


def keep(path: Path, sheet: Sheet, made_for: str) -> None:
    """Write a finished sheet to a file, with what it depends on."""
    write_atomically(path, json.dumps({"made_for": made_for, "sheet": asdict(sheet)}, indent=1) + "\n")


def kept(path: Path, made_for: str) -> Sheet | None:
    """Read a finished sheet; None if there is none, if it is damaged, or if it depends on something else."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        if record["made_for"] != made_for:
            return None
        questions = (
            Question(**one | {"parts": tuple(Part(**part) for part in one["parts"])})
            for one in record["sheet"]["questions"]
        )
        return Sheet(**record["sheet"] | {"questions": tuple(questions)})
    except (OSError, ValueError, KeyError, TypeError):
        return None
