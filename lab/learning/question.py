"""A question with choices, as quizzes and predictions ask it in a notebook."""

from __future__ import annotations

import re
from dataclasses import dataclass
from html import escape
from importlib import import_module

import ipywidgets
from IPython.display import HTML, display

from lab.errors import LabError

LETTERS = "abcdefgh"
_STYLE = """<style>
.course-choices > div { display: flex; flex-flow: column; align-items: flex-start; }
.course-choices button {
    width: auto; height: auto; line-height: 1.4; padding: 0.3em 0.8em; text-align: left; white-space: normal;
}
</style>"""  # by default ipywidgets puts buttons in a row and cuts long texts


@dataclass(frozen=True)
class Choice:
    """One of the answers to a question. `why` is shown when it is chosen, right or wrong."""

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
        """Return the choices under the letters that they have in a notebook."""
        return dict(zip(LETTERS, self.choices, strict=False))

    def letters(self) -> str:
        """Return the letters to choose from, such as "a, b or c"."""
        *others, last = self.by_letter()
        return f"{', '.join(others)} or {last}"

    def choice(self, letter: str) -> Choice:
        """Return the choice of a letter.

        Raises LabError when there is no such letter.
        """
        choices = self.by_letter()
        if letter not in choices:
            raise LabError(f"{letter!r} is not a choice; they are {', '.join(choices)}")
        return choices[letter]

    def text_under(self, title: str) -> HTML:
        """Show the question, without its choices."""
        return HTML(f"<p><b>{escape(title)}.</b> {in_html(self.text)}</p>{_STYLE}")

    def buttons(self) -> ipywidgets.ToggleButtons:
        """Return a button for each choice, none of them pressed; Tab goes from one to the next, Space presses it."""
        buttons = ipywidgets.ToggleButtons(
            options=[
                (f"{letter}  {choice.text.replace('`', '')}", letter)
                for letter, choice in self.by_letter().items()
            ],
            value=None,
        )
        return buttons.add_class("course-choices")

    def show(self, panel: ipywidgets.Widget, call: str) -> None:
        """Show the buttons; without widget support, show the choices and the `call` to type instead."""
        rows = "".join(
            f"<li><b>{letter}</b> {in_html(choice.text)}</li>" for letter, choice in self.by_letter().items()
        )
        without = f"<ul style='list-style: none'>{rows}</ul><p>Run <code>{escape(call)}</code> in a cell.</p>"
        display({**panel._repr_mimebundle_(), "text/html": without}, raw=True)


def in_html(text: str) -> str:
    """Return a text as HTML; text between backticks becomes code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(text))


def read_question(chapter: str, kind: str, number: int) -> Question:
    """Return a question of a chapter (`chapters/support/questions`); `kind` is "QUESTIONS" or "PREDICTIONS".

    Raises LabError when the chapter has no question of that number.
    """
    questions = getattr(import_module(f"chapters.support.questions.{chapter}"), kind)
    if not 1 <= number <= len(questions):
        raise LabError(f"there is no question {number} in {chapter!r}; it has 1 to {len(questions)}")
    return questions[number - 1]
