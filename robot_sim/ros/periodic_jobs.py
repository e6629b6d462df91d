"""Periodic work in simulated time."""

from __future__ import annotations

from collections.abc import Callable

TOLERANCE = 1e-6  # s; a sum of timesteps and a sum of periods can be the same time, but differ by rounding


class PeriodicJobs:
    """Jobs, each called at a rate (Hz) in simulated time; after a delay a job is called once, not once per period.

    If time goes back, as at a reset, every job is due at once.

    Attributes:
        next_due: simulated time (s) at which the next job is due.
    """

    def __init__(self, *jobs: tuple[float, Callable[[], None]]) -> None:
        self._periods = [1.0 / rate for rate, _ in jobs]
        self._jobs = [job for _, job in jobs]
        self.restart()

    def restart(self) -> None:
        """Make every job due at once."""
        self._due = [0.0] * len(self._jobs)
        self.next_due = 0.0
        self._latest = 0.0

    def run(self, now: float) -> None:
        """Call the jobs that are due at simulated time `now` (s)."""
        if now < self._latest:
            self.restart()
        self._latest = now
        if now < self.next_due - TOLERANCE:
            return
        for index, job in enumerate(self._jobs):
            if now >= self._due[index] - TOLERANCE:
                self._due[index] = max(self._due[index] + self._periods[index], now)
                job()
        self.next_due = min(self._due)
