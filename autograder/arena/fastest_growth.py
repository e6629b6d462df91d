"""The highest growth rate of a total that is sampled at irregular times."""

from __future__ import annotations

from collections import deque


class FastestGrowth:
    """The highest growth rate (1/s) of a total, averaged over intervals of at least a given length."""

    def __init__(self) -> None:
        self._looks: deque[tuple[float, float]] = deque()  # s, total
        self.rate = 0.0

    def look(self, now: float, total: float, stretch: float) -> None:
        """Add a sample of the total at time `now` (s); intervals shorter than `stretch` (s) count as `stretch`."""
        self._looks.append((now, total))
        while len(self._looks) > 1 and now - self._looks[1][0] >= stretch:
            self._looks.popleft()
        then, before = self._looks[0]
        self.rate = max(self.rate, (total - before) / max(stretch, now - then))
