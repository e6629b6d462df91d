"""The choices that you have made, under the text of their question: reordering questions or choices does no harm."""

from __future__ import annotations

from lab.learning.progress_file import Kind, keep, kept
from lab.learning.question import Question


def kept_letter(kind: Kind, question: Question) -> str | None:
    """Return the letter chosen earlier, or None; a choice whose words have changed since does not count."""
    text = kept(kind).get(question.text)
    return next((letter for letter, choice in question.by_letter().items() if choice.text == text), None)


def keep_letter(kind: Kind, question: Question, letter: str | None) -> None:
    """Write down the choice made for a question, or forget it when there is none."""
    keep(kind, question.text, None if letter is None else question.choice(letter).text)
