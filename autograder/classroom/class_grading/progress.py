"""The progress display of a batch: the number of graded submissions, the time left, and the running jobs."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.markup import escape
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from autograder.classroom.batch.job import GradingJob, Outcome
from autograder.classroom.batch.runner import Graded
from autograder.engine.verdict import CheckVerdict
from autograder.report.console import NOTICE
from autograder.report.table import progress_line

MAX_LISTED_JOBS = 8  # running submissions that are listed
PRINT_PERIOD = 30.0  # s between two progress lines without a terminal
BAR_WIDTH = 20  # characters


class BatchProgress:
    """Redraws lines at the bottom of a terminal; without a terminal, prints a line every half minute.

    Args:
        console: the output.
        elsewhere: number of workers on other machines, whose running jobs are not shown.
        clock: returns the time, s.
    """

    def __init__(
        self,
        console: Console,
        *,
        elsewhere: int = 0,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._console = console
        self._submissions: int | None = None  # unknown while submissions arrive
        self._elsewhere = elsewhere
        self._clock = clock
        self._pace = Pace(0, clock)
        self._graded = 0
        self._began: dict[tuple[str, str], float] = {}  # start time of each running job, s
        self._printed_at = clock()
        self._lock = threading.Lock()
        self._live = (
            Live(get_renderable=self._display, console=console, refresh_per_second=2, transient=True)
            if console.is_terminal
            else None
        )

    def __enter__(self) -> BatchProgress:
        if self._live:
            self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        if self._live:
            self._live.stop()

    def expect(self, checks: int, submissions: int) -> None:
        """Set the expected number of verdicts and of submissions."""
        self._pace.expect(checks)
        self._submissions = submissions

    def verdict(self, _verdict: CheckVerdict) -> None:
        """Count a verdict; may be called on any thread."""
        with self._lock:
            self._pace.add()
        self._print_when_due()

    def begin(self, job: GradingJob) -> None:
        """Show that a job runs; may be called on any thread."""
        with self._lock:
            self._began[job.student, job.exercise] = self._clock()
        self._print_when_due()

    def end(self, job: GradingJob) -> None:
        """Show a job no more; may be called on any thread."""
        with self._lock:
            del self._began[job.student, job.exercise]
        self._print_when_due()

    def retry_later(self, job: GradingJob, outcome: Outcome) -> None:
        """Print that a job could not be graded and will be retried at the end."""
        if not self._elsewhere:  # the job's verdicts were counted and will be counted again
            self._pace.expect(len(outcome.grade.checks))
        self._console.print(
            f"{job.student} · {job.exercise}  not graded yet, will be retried alone at the end: "
            f"{outcome.grade.why_not_graded}",
            style=NOTICE,
            markup=False,
            soft_wrap=True,
        )

    def graded(self, result: Graded, checks: int) -> None:
        """Print the line of a result; `checks` is the number of verdicts that it should have."""
        given = len(result.grade.checks)
        with self._lock:
            self._graded += 1
            self._pace.add(max(0, checks - given))
            if result.cached or not (result.effort and result.effort.arenas):
                self._pace.exclude_from_rate(checks)
        self._console.print(progress_line(result.grade, cached=result.cached))
        self._print_when_due()

    def _print_when_due(self) -> None:
        if self._live or self._clock() - self._printed_at < PRINT_PERIOD:
            return
        self._printed_at = self._clock()
        running = f"; running: {', '.join(self._names())}" if self._began else ""
        self._console.print(f"… {self._summary()}{running}", style="dim", markup=False, soft_wrap=True)

    def _summary(self) -> str:
        if self._submissions is None:
            return f"{self._graded} graded"
        left = in_words(self._pace.seconds_left())
        return f"{self._graded} of {self._submissions} submissions graded, {left}"

    def _names(self) -> list[str]:
        names = [f"{student} · {exercise}" for student, exercise in list(self._began)]
        return names[:MAX_LISTED_JOBS] + (
            [f"{len(names) - MAX_LISTED_JOBS} more"] if len(names) > MAX_LISTED_JOBS else []
        )

    def _display(self) -> RenderableType:
        with self._lock:
            rows, now = list(self._began.items()), self._clock()
            first = Table.grid(padding=(0, 1))
            if self._submissions is None:
                first.add_row(Text(self._summary()))
            else:
                bar = ProgressBar(
                    total=max(1, self._pace.expected), completed=self._pace.done, width=BAR_WIDTH
                )
                first.add_row(bar, Text(self._summary()))
        table = Table.grid(padding=(0, 2))
        for (student, exercise), since in rows[:MAX_LISTED_JOBS]:
            minutes, seconds = divmod(int(now - since), 60)
            table.add_row("  running", escape(f"{student} · {exercise}"), f"{minutes}:{seconds:02}")
        if len(rows) > MAX_LISTED_JOBS:
            table.add_row("", f"and {len(rows) - MAX_LISTED_JOBS} more", "")
        if self._elsewhere:
            table.add_row("  running", f"on {self._elsewhere} workers of the cluster", "")
        return Group(first, table)


class Pace:
    """Counts done items and estimates the time left; items from the cache count as done, but not for the rate."""

    def __init__(self, expected: int, clock: Callable[[], float] = time.monotonic) -> None:
        self.expected = expected
        self.done = 0
        self._excluded = 0
        self._clock = clock
        self._began = clock()

    def add(self, number: int = 1) -> None:
        """Add `number` done items."""
        self.done += number

    def exclude_from_rate(self, number: int) -> None:
        """Exclude `number` of the done items from the rate, because they came from the cache."""
        self._excluded += number

    def expect(self, number: int) -> None:
        """Add `number` expected items."""
        self.expected += number

    def seconds_left(self) -> float | None:
        """Return the time left (s) at the rate so far; None while the rate is unknown."""
        measured, elapsed = self.done - self._excluded, self._clock() - self._began
        if measured <= 0 or elapsed <= 0:
            return None
        return max(0, self.expected - self.done) * elapsed / measured


def in_words(seconds: float | None) -> str:
    """Return the time left, rounded as an estimate: to 10 s, a minute or 0.1 h."""
    if seconds is None:
        return "time left not known yet"
    if seconds < 60:
        return f"about {max(1, round(seconds / 10)) * 10} s left"
    if seconds < 5400:
        return f"about {round(seconds / 60)} min left"
    return f"about {seconds / 3600:.1f} h left"
