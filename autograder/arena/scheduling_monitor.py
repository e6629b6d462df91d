"""Measures scheduling delays in an arena without a robot; a robot reports its own lateness."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.student import Student

PERIOD = 0.1  # s on the arena's clock


class SchedulingMonitor:
    """Records how late the arena's own process is woken, and how long the student's gets no processor."""

    def __init__(self, log: ArenaLog, student: Student) -> None:
        self._log = log
        self._student = student

    @contextmanager
    def watch(self) -> Iterator[None]:
        """Measure while the scenario runs: sleep again and again, and record each new longest delay."""
        over = threading.Event()
        threading.Thread(target=self._sleep, args=(over,), name="scheduling monitor", daemon=True).start()
        try:
            yield
        finally:
            over.set()
            self._student.record_waiting()

    def _sleep(self, over: threading.Event) -> None:
        worst = 0.0
        while not over.is_set():
            before = time.monotonic()
            time.sleep(PERIOD)
            late = time.monotonic() - before - PERIOD
            if late > worst:
                worst = late
                self._log.append(ev.WokenLate(late=late))
