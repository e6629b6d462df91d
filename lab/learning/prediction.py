"""Predictions: the student chooses an outcome before an experiment and gets feedback on the choice afterwards."""

from __future__ import annotations

from html import escape

import ipywidgets
from IPython.display import display

from lab.errors import LabError
from lab.learning.question import (
    Question,
    as_status,
    read_question,
    store_letter,
    stored_letter,
    with_shuffled_choices,
)


def predict(chapter: str, number: int) -> Prediction:
    """Return a prediction of a chapter, with the choice that was made earlier, to show before its experiment.

        prediction_1 = lab.predict("services", 1)
        prediction_1            # a cell that shows the question and its buttons
        prediction_1.require()  # the first line of the experiment
        prediction_1.reply()    # a cell after the experiment

    Raises LabError when the chapter has no prediction of that number.
    """
    return Prediction(number, with_shuffled_choices(read_question(chapter, "predictions", number)))


class Prediction:
    """A question before an experiment: click an answer, or call `choose("b")` where there are no widgets.

    The choice is stored beside the notebook, so it survives a restart of the kernel.
    """

    def __init__(self, number: int, question: Question) -> None:
        self.number = number
        self.question = question
        self._has_stopped_the_experiment = False
        self._buttons = question.buttons()
        self._buttons.value = stored_letter("predictions", question)
        self._buttons.observe(lambda change: store_letter("predictions", question, change["new"]), "value")

    @property
    def letter(self) -> str | None:
        """The letter of the current choice; None without one."""
        return self._buttons.value

    def choose(self, letter: str) -> None:
        """Make or change the choice.

        Raises LabError when there is no such letter.
        """
        self.question.choice(letter)
        self._buttons.value = letter

    answer = choose  # the name that quiz questions have for it

    def clear(self) -> None:
        """Delete the choice."""
        self._buttons.value = None

    def require(self) -> None:
        """Require a choice; an experiment calls it in its first line.

        Raises LabError when nothing is chosen.
        """
        self._has_stopped_the_experiment = self.letter is None
        if self.letter is None:
            raise LabError(self._request())

    def reply(self) -> None:
        """Print the feedback on the choice; without a choice, or if only `require()` has run since, ask for more."""
        if self.letter is None:
            print(self._request())
            return
        if self._has_stopped_the_experiment:
            print("Predict first, then run the experiment: its cell has not run since you chose. Run it now.")
            return
        choice = self.question.choice(self.letter)
        print(f"You predicted {self.letter}: {choice.text}")
        print("Right." if choice.right else "It went differently.", choice.why)

    def _request(self) -> str:
        return (
            f"Predict first: click {self.question.letters()} under Prediction {self.number}, "
            f"or run {self._call()} in a cell"
        )

    def _call(self) -> str:
        return f'prediction_{self.number}.choose("a")'

    def _ipython_display_(self) -> None:
        display(self.question.text_under(f"Prediction {self.number}"))
        self.question.show(self._panel(), self._call())

    def _panel(self) -> ipywidgets.VBox:
        note = ipywidgets.HTML()
        clear = ipywidgets.Button(
            description="Clear", tooltip="Delete my prediction", layout={"width": "auto"}
        )
        clear.on_click(lambda _: self.clear())

        def update_note(_: dict | None = None) -> None:
            chosen = f"You predict {self.letter}. Run the next cell."
            note.value = as_status(escape(chosen if self.letter else f"Choose {self.question.letters()}."))

        self._buttons.observe(update_note, "value")
        update_note()
        return ipywidgets.VBox([self._buttons, ipywidgets.HBox([note, clear])])
