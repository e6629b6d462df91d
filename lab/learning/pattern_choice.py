"""Questions, asked one after the other, that lead to the choice of topic, service or action."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape

import ipywidgets
from IPython.display import display

from lab.errors import LabError


@dataclass(frozen=True)
class Step:
    """A question whose "yes" decides for a pattern; `reason` says why."""

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
        "only an action sends feedback while it works. A service is silent until its response.",
    ),
    Step(
        "Duration: does it take so long that the caller needs to know whether it still runs?",
        "action",
        "an action tells the status of its goal at any time. "
        "If a few seconds of silence do no harm, answer no: the length alone does not decide.",
    ),
    Step(
        "Answer: does the caller need to know what came of it?",
        "service",
        "each request of a service gets its own response, and nothing needs a cancel or feedback.",
    ),
)
OTHERWISE = Step(
    "",
    "topic",
    "nobody needs an answer. The next message makes up for one that gets lost, and any node can subscribe.",
)


def choose_pattern() -> PatternChoice:
    """Return the questions that lead from your situation to topic, service or action, to be shown in a cell.

    pattern = lab.choose_pattern()
    pattern                # shows the first question, with buttons
    pattern.answer("no")   # the same without buttons
    """
    return PatternChoice()


class PatternChoice:
    """Yes-or-no questions: click, or Tab and Space, or `answer("yes")` where there are no widgets.

    The first yes decides; without one it is a topic.
    """

    def __init__(self) -> None:
        self._asked = 0  # number of questions answered with no
        self._decided = False
        self._note = ipywidgets.HTML()
        self._buttons = {word: ipywidgets.Button(description=word.capitalize()) for word in ("yes", "no")}
        for word, button in self._buttons.items():
            button.on_click(lambda _, word=word: self._take(word))
        self._restart = ipywidgets.Button(description="Start again")
        self._restart.on_click(lambda _: self.restart())
        self._show()

    @property
    def pattern(self) -> str | None:
        """The pattern that the answers lead to; None while there are questions left."""
        decisive = self._decisive()
        return decisive.pattern if decisive else None

    def answer(self, word: str) -> None:
        """Answer the present question with "yes" or "no", and print what follows.

        Raises LabError for another word, or when the pattern is decided already.
        """
        if word not in self._buttons:
            raise LabError(f'{word!r} is no answer; write "yes" or "no"')
        if self.pattern:
            raise LabError(f"the pattern is decided: {self.pattern}; begin again with restart()")
        self._take(word)
        print(self.text())

    def restart(self) -> None:
        """Begin again with the first question."""
        self._asked, self._decided = 0, False
        self._show()

    def text(self) -> str:
        """Return the present question, or the pattern and its reason."""
        decisive = self._decisive()
        if decisive is None:
            return f"Question {self._asked + 1}. {STEPS[self._asked].question}"
        return f"{decisive.pattern.capitalize()}: {decisive.reason}"

    def _decisive(self) -> Step | None:
        if self._decided:
            return STEPS[self._asked]
        return OTHERWISE if self._asked == len(STEPS) else None

    def _take(self, word: str) -> None:
        if word == "yes":
            self._decided = True
        else:
            self._asked += 1
        self._show()

    def _show(self) -> None:
        self._note.value = escape(self.text())
        for button in self._buttons.values():
            button.disabled = self.pattern is not None

    def _ipython_display_(self) -> None:
        display(self._panel())

    def _panel(self) -> ipywidgets.VBox:
        return ipywidgets.VBox([self._note, ipywidgets.HBox([*self._buttons.values(), self._restart])])
