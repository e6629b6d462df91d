"""The order in which you see choices, and those that you have made, under the text of their question."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from lab.learning.progress_file import Kind, keep, kept, own_number
from lab.learning.question import Question


def in_your_order(question: Question) -> Question:
    """Shuffle the choices: in another order for each student, and in the same one every time."""
    order = Random(f"{own_number()} {question.text}")
    return replace(question, choices=tuple(order.sample(question.choices, len(question.choices))))


def kept_letter(kind: Kind, question: Question) -> str | None:
    """Return the letter chosen earlier, or None; a choice whose words have changed since does not count."""
    text = kept(kind).get(question.text)
    return next((letter for letter, choice in question.by_letter().items() if choice.text == text), None)


def keep_letter(kind: Kind, question: Question, letter: str | None) -> None:
    """Write down the choice made for a question, or forget it when there is none."""
    keep(kind, question.text, None if letter is None else question.choice(letter).text)
