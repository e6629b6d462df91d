"""Periodic work in simulated time."""

from __future__ import annotations

from collections.abc import Callable


class Schedule:
    """Calls each job at its own rate (Hz) of simulated time; a late call is made once, not caught up on.

    When time has gone back, as at a reset, every job is due at once.
    """

    def __init__(self, *jobs: tuple[float, Callable[[], None]]) -> None:
        self._periods = [1.0 / rate for rate, _ in jobs]
        self._jobs = [job for _, job in jobs]
        self.restart()

    def restart(self) -> None:
        """Make every job due at once."""
        self._due = [0.0] * len(self._jobs)
        self._latest = 0.0

    def run(self, now: float) -> None:
        """Call the jobs that are due at simulated time `now` (s)."""
        if now < self._latest:
            self.restart()
        self._latest = now
        for index, job in enumerate(self._jobs):
            if now >= self._due[index]:
                self._due[index] = max(self._due[index] + self._periods[index], now)
                job()
