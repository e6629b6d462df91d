"""The rate of a batch, and an estimate of the time left."""

from __future__ import annotations

import time
from collections.abc import Callable


class Pace:
    """Counts done items of `expected`; items from the cache count as done but not for the rate."""

    def __init__(self, expected: int, clock: Callable[[], float] = time.monotonic) -> None:
        self.expected = expected
        self.done = 0
        self._known = 0
        self._clock = clock
        self._began = clock()

    def add(self, number: int = 1) -> None:
        """Add `number` done items."""
        self.done += number

    def was_known(self, number: int) -> None:
        """Exclude `number` of the done items from the rate, because they came from the cache."""
        self._known += number

    def expect(self, number: int) -> None:
        """Add `number` expected items."""
        self.expected += number

    def seconds_left(self) -> float | None:
        """Return the time left (s) at the rate so far; None before anything was measured."""
        measured, elapsed = self.done - self._known, self._clock() - self._began
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
