"""Processor time that a program missed because other programs occupied the processors."""

from __future__ import annotations


class LostTime:
    """Adds up how much less than one processor a program got while its processes were waiting for one.

    A program that already gets one processor's worth of time, over all its processes, loses nothing: a correct one
    needs no more, and its processes then wait for each other.
    """

    def __init__(self) -> None:
        self.total = 0.0  # s
        self._last: tuple[float, float, float] | None = None

    def look(self, now: float, used: float, waited: float) -> None:
        """Add a sample at time `now` (s): the totals (s) of used and of awaited processor time over all processes."""
        then, used_then, waited_then = self._last or (now, used, waited)
        lacking = (now - then) - (used - used_then)
        self.total += max(0.0, min(waited - waited_then, lacking))
        self._last = now, used, waited
