"""Predictions and quiz questions as static HTML: the question, its choices, and a folded reply to each."""

from __future__ import annotations

from lab.learning.question import Question, in_html


def prediction(number: int, question: Question) -> str:
    """Return a prediction's question and choices, as HTML."""
    rows = "".join(
        f"<li><b>{letter}</b> {in_html(choice.text)}</li>" for letter, choice in question.by_letter().items()
    )
    return _box(f"Prediction {number}", f"{_words(question)}<ul>{rows}</ul>")


def replies(number: int, question: Question) -> str:
    """Return the replies to a prediction, folded, as HTML."""
    return _box(f"Prediction {number}: replies", _folded(question, wrong="It went differently."))


def quiz(number: int, question: Question) -> str:
    """Return a quiz question with a folded reply to each choice, as HTML."""
    return _box(f"Question {number}", _words(question) + _folded(question, wrong="Not this one."))


def _words(question: Question) -> str:
    return f"<p>{in_html(question.text)}</p>"


def _folded(question: Question, wrong: str) -> str:
    return "".join(
        f"<details><summary><b>{letter}</b> {in_html(choice.text)}</summary>"
        f"<p>{'Right.' if choice.right else wrong} {in_html(choice.why)}</p></details>"
        for letter, choice in question.by_letter().items()
    )


def _box(title: str, content: str) -> str:
    return f'<div class="question"><p><b>{title}</b></p>{content}</div>'
