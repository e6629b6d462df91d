"""The order of a question's choices for this student, and the choices made so far, stored by the question's text."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from lab.learning.progress_file import Kind, keep, kept, own_number
from lab.learning.question import Question


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
