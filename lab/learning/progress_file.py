"""Stores the student's progress in the chapters in a file beside the notebooks, so that it outlives the kernel."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from random import Random, randrange
from typing import Literal

from lab.learning.question import Question
from lab.running.programs_folder import notebook_folder
from ros_runtime.self_checks import entries_of, read_progress_file

NAME = ".progress.json"  # hidden, as the files of tools are
Kind = Literal["predictions", "questions", "gaps"]


def kept(kind: Kind, folder: Path | None = None) -> dict[str, str]:
    """Return the entries of one kind, such as chosen answers or times of filled gaps; `folder`: of the notebooks."""
    return entries_of((folder or notebook_folder()) / NAME, kind)


def keep(kind: Kind, key: str, value: str | None) -> None:
    """Store a value under its key; None deletes the key."""
    entries = kept(kind)
    entries.pop(key, None)
    if value is not None:
        entries[key] = value
    _write({**_everything(), kind: entries})


def own_number() -> int:
    """Return a random number that was drawn once for this folder of notebooks, so it differs between students."""
    everything = _everything()
    if not isinstance(number := everything.get("number"), int):
        number = randrange(10**9)
        _write({**everything, "number": number})
    return number


def in_your_order(question: Question) -> Question:
    """Shuffle the choices: the order differs between students and stays the same for one student."""
    order = Random(f"{own_number()} {question.text}")
    return replace(question, choices=tuple(order.sample(question.choices, len(question.choices))))


def kept_letter(kind: Kind, question: Question) -> str | None:
    """Return the letter chosen earlier; None without one, or if the text of that choice has changed since."""
    text = kept(kind).get(question.text)
    return next((letter for letter, choice in question.by_letter().items() if choice.text == text), None)


def keep_letter(kind: Kind, question: Question, letter: str | None) -> None:
    """Store the choice made for a question; None deletes it."""
    keep(kind, question.text, None if letter is None else question.choice(letter).text)


def _everything() -> dict:
    return read_progress_file(notebook_folder() / NAME)


def _write(everything: dict) -> None:
    (notebook_folder() / NAME).write_text(
        json.dumps(everything, indent=1, ensure_ascii=False) + "\n", encoding="utf-8"
    )
