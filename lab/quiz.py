"""Quiz questions with immediate feedback and a reason for each choice."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from importlib import import_module

import ipywidgets
from IPython.display import HTML, display

from lab.errors import LabError

LETTERS = "abcdefgh"


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


def quiz(chapter: str, number: int) -> Quiz:
    """Return a question of a chapter, such as `quiz("services", 1)`.

    Raises LabError when the chapter has no question of that number.
    """
    questions = import_module(f"lab.questions.{chapter}").QUESTIONS
    if not 1 <= number <= len(questions):
        raise LabError(f"there is no question {number} in {chapter!r}; it has 1 to {len(questions)}")
    return Quiz(f"Question {number}", questions[number - 1])


class Quiz:
    """A question in a notebook: click a button, or call `answer("b")` where there are no widgets."""

    def __init__(self, title: str, question: Question) -> None:
        self.title = title
        self.question = question

    def answer(self, letter: str) -> None:
        """Print whether this choice is right, and why."""
        print(self.mark(letter))

    def mark(self, letter: str) -> str:
        """Return the feedback on a choice as a sentence.

        Raises LabError when there is no such letter.
        """
        choices = self._by_letter()
        if letter not in choices:
            raise LabError(f"{letter!r} is not a choice; they are {', '.join(choices)}")
        choice = choices[letter]
        return f"{letter}: {'Right.' if choice.right else 'Not this one.'} {choice.why}"

    def _ipython_display_(self) -> None:
        rows = "".join(
            f"<li><b>{letter}</b> {escape(choice.text)}</li>" for letter, choice in self._by_letter().items()
        )
        display(
            HTML(
                f"<p><b>{escape(self.title)}.</b> {escape(self.question.text)}</p>"
                f'<ul style="list-style: none">{rows}</ul>'
            )
        )
        display(self._buttons())

    def _buttons(self) -> ipywidgets.VBox:
        verdict = ipywidgets.HTML()

        def mark(change: dict) -> None:
            if change["new"]:
                verdict.value = escape(self.mark(change["new"]))

        buttons = ipywidgets.ToggleButtons(
            options=list(self._by_letter()), value=None, style={"button_width": "3em"}
        )
        buttons.observe(mark, "value")
        return ipywidgets.VBox([buttons, verdict])

    def _by_letter(self) -> dict[str, Choice]:
        return dict(zip(LETTERS, self.question.choices, strict=False))
