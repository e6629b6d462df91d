"""The verdicts of a self-check as a part of the notebook's page, which is updated while the checks run."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Sequence
from threading import Lock

from IPython.display import display
from markupsafe import Markup, escape

from autograder.authoring.checks import Check
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.lesson import address, in_words
from autograder.engine.verdict import CheckVerdict
from autograder.report.rendering import ENVIRONMENT
from autograder.report.sequence import has_messages, transcript_svg
from autograder.report.table import MARKS, reasons


class NotebookTable:
    """Shows the verdicts of a self-check; its methods may be called on any thread.

    Attributes:
        evidence: the runs on which each failed check was judged, by its id.
    """

    def __init__(self, checks: Sequence[Check]) -> None:
        self.evidence: dict[str, Sequence[Transcript]] = {}
        self._checks = checks
        self._verdicts: dict[str, CheckVerdict] = {}
        self._drawings: dict[str, Markup] = {}
        self._films: dict[str, Markup] = {}
        self._changing = Lock()
        self._shown = display(self._content(), raw=True, display_id=True)

    def add(self, verdict: CheckVerdict) -> None:
        """Show a verdict."""
        with self._changing:
            self._verdicts[verdict.id] = verdict
            self._update()

    def draw(self, verdict: CheckVerdict, transcripts: Sequence[Transcript]) -> None:
        """Draw the last run that a failed check was judged on, if anything was sent in it."""
        if verdict.status == "failed" and transcripts:
            title = transcripts[-1].scenario.replace("_", " ")
            with self._changing:
                self.evidence[verdict.id] = transcripts
                if has_messages(transcripts[-1]):
                    self._drawings[verdict.id] = Markup(transcript_svg(transcripts[-1], title))
                self._update()

    def film(self, check_id: str, words: str, webp: bytes = b"") -> None:
        """Show a film of the seconds around a failure, or the words instead of one; empty words remove the entry."""
        data = b64encode(webp).decode()
        image = Markup('<img src="data:image/webp;base64,{}" alt="{}">').format(data, words)
        with self._changing:
            self._films[check_id] = image if webp else escape(words)
            self._update()

    def _update(self) -> None:
        if self._shown is not None:
            self._shown.update(self._content(), raw=True)

    def _content(self) -> dict[str, str]:
        """Return the table as HTML, and as text for programs that show none."""
        judged = [self._verdicts[check.id] for check in self._checks if check.id in self._verdicts]
        folded = {
            "passed": [verdict.title for verdict in judged if verdict.status == "passed"],
            "not run": [
                f"{verdict.title}. {verdict.help}" for verdict in judged if verdict.status == "not run"
            ],
            "not judged yet": [check.title for check in self._checks if check.id not in self._verdicts],
        }
        template = ENVIRONMENT.get_template("self_check.html")
        html = template.render(
            judged=judged, folded=folded, drawings=self._drawings, films=self._films, next_step=next_step
        )
        return {"text/html": html, "text/plain": "\n".join(map(_in_text, judged))}


def next_step(verdict: CheckVerdict) -> Markup:
    """Return the advice of a verdict, in which the lesson is a link."""
    words = in_words(verdict.lesson)
    link = Markup('<a href="{}">{}</a>').format(address(verdict.lesson), words)
    return escape(verdict.help).replace(escape(words), link) if verdict.lesson else escape(verdict.help)


def _in_text(verdict: CheckVerdict) -> str:
    lines = [f"{MARKS[verdict.status][0]} {verdict.title}  {verdict.points}/{verdict.max_points}"]
    if verdict.status != "passed":
        lines += [f"    {label}  {text}" for label, text in reasons(verdict).items()]
    return "\n".join(lines)
