"""A status line with the checks whose scenarios run, below the verdicts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from types import TracebackType

from rich.console import Console
from rich.status import Status

from autograder.authoring.checks import Check, Scenario
from autograder.engine.verdict import CheckVerdict


class RunningLine:
    """A status line: in a terminal the last line, in a notebook an overwritten line, elsewhere a line per change."""

    def __init__(self, console: Console, checks: Sequence[Check], *, in_notebook: bool = False) -> None:
        self._console = console
        self._checks = checks
        self._in_notebook = in_notebook
        self._status = Status("", console=console) if console.is_terminal and not in_notebook else None
        self._shown = ""
        self._judged: set[str] = set()
        self._retried: set[str] = set()

    def __enter__(self) -> RunningLine:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
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
        elif self._in_notebook:
            print(f"\r{text:<{len(self._shown)}}\r{text}", end="", flush=True)
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

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Remove the line while the block prints, and show it again afterwards."""
        shown = self._shown
        if self._in_notebook and shown:
            print(f"\r{'':<{len(shown)}}\r", end="")
        yield
        if self._in_notebook and shown:
            print(shown, end="", flush=True)
