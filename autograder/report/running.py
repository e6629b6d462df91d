"""A status line with the checks whose scenarios run, below the verdicts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rich.console import Console
from rich.status import Status

from autograder.authoring.checks import Check, Scenario
from autograder.engine.verdict import CheckVerdict

if TYPE_CHECKING:
    from ros_runtime.cell_notice import CellNotice


class RunningLine:
    """A status line: in a terminal the last line, in a notebook its notice, elsewhere a line per change."""

    def __init__(self, console: Console, checks: Sequence[Check], notice: CellNotice | None = None) -> None:
        self._console = console
        self._checks = checks
        self._notice = notice
        self._status = Status("", console=console) if console.is_terminal and not notice else None
        self._shown = ""
        self._judged: set[str] = set()
        self._retried: set[str] = set()

    def __enter__(self) -> RunningLine:
        return self

    def __exit__(self, *_: object) -> None:
        self.show([])

    def show(self, scenarios: Sequence[Scenario]) -> None:
        """Show the title of a check without a verdict for each running scenario; none removes the line."""
        titles = [self._title_for(each) for each in scenarios]
        text = f"checking: {'; '.join(dict.fromkeys(titles))}" if titles else ""
        if text == self._shown:
            return
        if self._status:
            self._status.update(text)
            self._status.start() if text else self._status.stop()
        elif self._notice:
            self._notice.show(text)
        elif text:
            self._console.print(text, style="dim", highlight=False)
        self._shown = text

    def note(self, verdict: CheckVerdict) -> None:
        """Note that a check has its verdict."""
        self._judged.add(verdict.id)

    def note_retry(self, check: Check) -> None:
        """Note that a check has failed once, and is retried."""
        self._retried.add(check.id)

    def _title_for(self, scenario: Scenario) -> str:
        checks = [check for check in self._checks if scenario in check.on]
        shown = next((check for check in checks if check.id not in self._judged), checks[0])
        return f"{shown.title} (failed once, retrying)" if shown.id in self._retried else shown.title
