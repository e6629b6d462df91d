"""The questions of quizzes and predictions: how they look in a notebook, and where the student's choice is stored."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cache
from html import escape
from importlib.resources import files
from random import Random

import ipywidgets
import yaml
from IPython.display import HTML, display

from lab.errors import LabError
from lab.learning.progress_file import Kind, read_entries, shuffle_seed, store_entry

LETTERS = "abcdefgh"
_FOLDER = files("chapters.support") / "questions"
_STYLE = """<style>
.course-choices { width: auto; height: auto; }
.course-choices label { height: auto; line-height: 1.4; padding: 0.3em 0; cursor: pointer; }
.course-choices label input { height: 1.4em; margin-left: 4px; accent-color: var(--jp-brand-color1); }
.course-choices input:focus-visible { outline: 2px solid var(--jp-brand-color1); outline-offset: 1px; }
</style>"""  # by default ipywidgets cuts long texts


@dataclass(frozen=True)
class Choice:
    """One of the answers to a question; `why` explains why it is right or wrong, and is shown when it is chosen."""

    text: str
    why: str
    right: bool = False


@dataclass(frozen=True)
class Question:
    """A question with exactly one right choice."""

    text: str
    choices: tuple[Choice, ...]

    def __post_init__(self) -> None:
        if sum(choice.right for choice in self.choices) != 1:
            raise ValueError(f"the question {self.text!r} needs exactly one right choice")

    def by_letter(self) -> dict[str, Choice]:
        """Return the choices by the letters under which a notebook shows them."""
        return dict(zip(LETTERS, self.choices, strict=False))

    def letters(self) -> str:
        """Return the letters in a sentence, such as "a, b or c"."""
        *others, last = self.by_letter()
        return f"{', '.join(others)} or {last}"

    def choice(self, letter: str) -> Choice:
        """Return the choice with this letter.

        Raises LabError when the question has no such letter.
        """
        choices = self.by_letter()
        if letter not in choices:
            raise LabError(f"{letter!r} is not a choice; the choices are {', '.join(choices)}")
        return choices[letter]

    def text_under(self, title: str) -> HTML:
        """Return the question as HTML below a title, without its choices."""
        return HTML(f"<p><b>{escape(title)}.</b> {in_html(self.text)}</p>{_STYLE}")

    def buttons(self) -> ipywidgets.RadioButtons:
        """Return a radio button for each choice, with none selected; a screen reader says which one is."""
        buttons = ipywidgets.RadioButtons(
            options=[
                (f"{letter}) {choice.text.replace('`', '')}", letter)
                for letter, choice in self.by_letter().items()
            ],
            value=None,
        )
        return buttons.add_class("course-choices")

    def show(self, panel: ipywidgets.Widget, call: str) -> None:
        """Show the panel with the buttons; without widget support, show the choices and the `call` to type instead."""
        rows = "".join(
            f"<li><b>{letter})</b> {in_html(choice.text)}</li>" for letter, choice in self.by_letter().items()
        )
        without = f"<ul style='list-style: none'>{rows}</ul><p>Run <code>{escape(call)}</code> in a cell.</p>"
        display({**panel._repr_mimebundle_(), "text/html": without}, raw=True)


def in_html(text: str) -> str:
    """Return a text as HTML; text between backticks becomes code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(text))


def as_status(html: str) -> str:
    """Return HTML that a screen reader reads out when it changes, although the focus is elsewhere."""
    return f'<span role="status">{html}</span>'


@cache
def read_questions(chapter: str, kind: Kind) -> tuple[Question, ...]:
    """Return a chapter's predictions or quiz questions, from `chapters/support/questions`.

    They are not in the notebook, so that students do not see the answers while they read.
    """
    text = (_FOLDER / f"{chapter}.yaml").read_text(encoding="utf-8")
    return tuple(
        Question(
            each["text"],
            tuple(
                Choice(choice["text"], choice["why"], choice.get("right") == "true")
                for choice in each["choices"]
            ),
        )
        for each in yaml.load(text, yaml.BaseLoader)[kind]
    )


def read_question(chapter: str, kind: Kind, number: int) -> Question:
    """Return one question of a chapter, counted from 1.

    Raises LabError when the chapter has no question with that number.
    """
    questions = read_questions(chapter, kind)
    if not 1 <= number <= len(questions):
        raise LabError(
            f"there is no question {number} in {chapter!r}; its questions are 1 to {len(questions)}"
        )
    return questions[number - 1]


def with_shuffled_choices(question: Question) -> Question:
    """Return the question with its choices in an order that differs between students but never changes for one."""
    order = Random(f"{shuffle_seed()} {question.text}")
    return replace(question, choices=tuple(order.sample(question.choices, len(question.choices))))


def stored_letter(kind: Kind, question: Question) -> str | None:
    """Return the letter chosen earlier; None if nothing was chosen, or if the text of that choice has changed."""
    text = read_entries(kind).get(question.text)
    return next((letter for letter, choice in question.by_letter().items() if choice.text == text), None)


def store_letter(kind: Kind, question: Question, letter: str | None) -> None:
    """Store the choice made for a question; None deletes it."""
    store_entry(kind, question.text, None if letter is None else question.choice(letter).text)
