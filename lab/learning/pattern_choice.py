"""A series of yes-or-no questions that leads to the choice of topic, service or action."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape

import ipywidgets
from IPython.display import display

from lab.errors import LabError
from lab.learning.question import as_status


@dataclass(frozen=True)
class Step:
    """A question; the answer "yes" means that `pattern` is the right one, and `reason` explains it."""

    question: str
    pattern: str
    reason: str


STEPS = (
    Step(
        "Cancel: may somebody want to stop it half-way?",
        "action",
        "only an action has a cancel: nobody can take back the request of a service.",
    ),
    Step(
        "Progress: does somebody need to see how far it is?",
        "action",
        "only an action sends feedback while it works. A service sends nothing until its response.",
    ),
    Step(
        "Duration: does it take so long that the caller needs to know whether it still runs?",
        "action",
        "an action publishes the status of its goal at any time. "
        "If the caller can wait a few seconds without news, answer no: a long duration alone needs no action.",
    ),
    Step(
        "Answer: does the caller need to know the outcome?",
        "service",
        "each request to a service gets its own response, and you need neither a cancel nor feedback.",
    ),
)
OTHERWISE = Step(
    "",
    "topic",
    "nobody needs an answer. If a message is lost, the next one replaces it, and any node can subscribe.",
)


def choose_pattern() -> PatternChoice:
    """Return a series of questions that leads from your situation to topic, service or action.

    pattern = lab.choose_pattern()
    pattern                # shows the first question, with buttons
    pattern.answer("no")   # answers it without the buttons
    """
    return PatternChoice()


class PatternChoice:
    """Yes-or-no questions in a notebook: click a button, or call `answer("yes")` where there are no widgets.

    The first "yes" decides the pattern. If every answer is "no", the pattern is a topic.
    """

    def __init__(self) -> None:
        self._answered_no = 0  # number of questions
        self._decided = False
        self._note = ipywidgets.HTML()
        self._buttons = {word: ipywidgets.Button(description=word.capitalize()) for word in ("yes", "no")}
        for word, button in self._buttons.items():
            button.on_click(
                lambda _, word=word: self._take(word)
            )  # never disabled: it would lose the keyboard's focus
        self._restart = ipywidgets.Button(description="Start again")
        self._restart.on_click(lambda _: self.restart())
        self._show()

    @property
    def pattern(self) -> str | None:
        """The pattern that the answers lead to; None while there are questions left."""
        decisive = self._decisive()
        return decisive.pattern if decisive else None

    def answer(self, word: str) -> None:
        """Answer the current question with "yes" or "no", and print the next question or the pattern.

        Raises LabError for another word, or when the pattern is already decided.
        """
        if word not in self._buttons:
            raise LabError(f'the answer {word!r} is not accepted; write "yes" or "no"')
        if self.pattern:
            raise LabError(f"the pattern is already decided: {self.pattern}; call restart() to begin again")
        self._take(word)
        print(self.text())

    def restart(self) -> None:
        """Begin again with the first question."""
        self._answered_no, self._decided = 0, False
        self._show()

    def text(self) -> str:
        """Return the current question, or the pattern and its reason."""
        decisive = self._decisive()
        if decisive is None:
            return f"Question {self._answered_no + 1}. {STEPS[self._answered_no].question}"
        return f"{decisive.pattern.capitalize()}: {decisive.reason}"

    def _decisive(self) -> Step | None:
        if self._decided:
            return STEPS[self._answered_no]
        return OTHERWISE if self._answered_no == len(STEPS) else None

    def _take(self, word: str) -> None:
        """Take an answer, unless the pattern is already decided."""
        if self.pattern:
            return
        if word == "yes":
            self._decided = True
        else:
            self._answered_no += 1
        self._show()

    def _show(self) -> None:
        self._note.value = as_status(escape(self.text()))

    def _ipython_display_(self) -> None:
        display(self._panel())

    def _panel(self) -> ipywidgets.VBox:
        return ipywidgets.VBox([self._note, ipywidgets.HBox([*self._buttons.values(), self._restart])])
