"""How long a program waited for a processor that other programs had."""

from __future__ import annotations


class LostTime:
    """Adds up what a program lacked to one processor while it waited for one.

    Processes that wait for each other lose nothing: a program that has a processor's worth of time already, spread
    over as many processes as it likes, has what a sound one needs, and the rest of its waiting is its own doing.
    """

    def __init__(self) -> None:
        self.total = 0.0  # s
        self._last: tuple[float, float, float] | None = None

    def look(self, now: float, used: float, waited: float) -> None:
        """Note, at a time (s), the processor time that all its processes used and waited for so far (s)."""
        then, used_then, waited_then = self._last or (now, used, waited)
        lacking = (now - then) - (used - used_then)
        self.total += max(0.0, min(waited - waited_then, lacking))
        self._last = now, used, waited
