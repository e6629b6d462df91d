"""Keeps simulated time in step with the system clock."""

from __future__ import annotations

import time


class Pacing:
    """A comparison of simulated time with the system clock.

    `real_time_factor` is simulated seconds per second of `time.monotonic()`; 0 means as fast as possible. A lag of
    more than `MAX_LAG` s is dropped, so that the simulation does not run at full speed to catch up after the
    machine was suspended.

    Attributes:
        dropped: the lag that was dropped so far, s.
    """

    MAX_LAG = 1.0

    def __init__(self, real_time_factor: float = 1.0) -> None:
        if real_time_factor < 0:
            raise ValueError(f"the real-time factor must not be negative, got {real_time_factor}")
        self.real_time_factor = real_time_factor
        self.dropped = 0.0
        self._worst_lag = 0.0
        self.restart(0.0)

    def restart(self, simulated: float) -> None:
        """Restart the comparison: simulated time `simulated` (s) is due now."""
        self._origin = time.monotonic()
        self._simulated_origin = simulated

    def lag(self, simulated: float) -> float:
        """Return how far (simulated s) the simulation is behind; negative when it is ahead."""
        if self.real_time_factor == 0:
            return 0.0
        due = self._simulated_origin + (time.monotonic() - self._origin) * self.real_time_factor
        lag = due - simulated
        self._worst_lag = max(self._worst_lag, lag)
        if lag > self.MAX_LAG:
            self.dropped += lag
            self.restart(simulated)
        return lag

    def take_worst_lag(self) -> float:
        """Return the greatest lag (simulated s, at least 0) since the last call, including dropped lags."""
        worst, self._worst_lag = self._worst_lag, 0.0
        return worst

    def wall_time_until(self, simulated: float) -> float:
        """Return the seconds of the system clock until `simulated` is due, at least 0."""
        if self.real_time_factor == 0:
            return 0.0
        return max(0.0, -self.lag(simulated) / self.real_time_factor)
