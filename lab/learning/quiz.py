"""Quiz questions, which explain each answer as soon as it is chosen."""

from __future__ import annotations

import ipywidgets
from IPython.display import display

from lab.learning.question import (
    Question,
    as_status,
    in_html,
    read_question,
    store_letter,
    stored_letter,
    with_shuffled_choices,
)


def quiz(chapter: str, number: int) -> Quiz:
    """Return a question of a chapter: `quiz("services", 1)` is the first one of chapter 2.

    Raises LabError when the chapter has no question with that number.
    """
    return Quiz(f"Question {number}", with_shuffled_choices(read_question(chapter, "questions", number)))


class Quiz:
    """A question in a notebook: click an answer, or call `answer("b")` where there are no widgets.

    The last answer is stored beside the notebook.
    """

    def __init__(self, title: str, question: Question) -> None:
        self.title = title
        self.question = question

    def answer(self, letter: str) -> None:
        """Store this choice, and print whether it is right, and why.

        Raises LabError when there is no such letter.
        """
        print(self.mark(letter))
        store_letter("questions", self.question, letter)

    choose = answer  # the name that predictions have for it

    def mark(self, letter: str) -> str:
        """Return a sentence that says whether a choice is right, and why.

        Raises LabError when there is no such letter.
        """
        choice = self.question.choice(letter)
        return f"{letter}: {'Right.' if choice.right else 'Not this one.'} {choice.why}"

    def _ipython_display_(self) -> None:
        display(self.question.text_under(self.title))
        self.question.show(self._buttons(), f'{self.title.lower().replace(" ", "_")}.answer("a")')

    def _buttons(self) -> ipywidgets.VBox:
        verdict = ipywidgets.HTML()

        def mark(change: dict) -> None:
            if change["new"]:
                verdict.value = as_status(in_html(self.mark(change["new"])))
                store_letter("questions", self.question, change["new"])

        buttons = self.question.buttons()
        buttons.observe(mark, "value")
        buttons.value = stored_letter("questions", self.question)
        return ipywidgets.VBox([buttons, verdict])
