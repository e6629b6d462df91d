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


@contextmanager
def watch_scheduling(log: ArenaLog, student: Student) -> Iterator[None]:
    """Record, during the scenario, how late this process wakes up, and how long the student's waits for a processor."""
    over = threading.Event()
    threading.Thread(target=_sleep, args=(log, over), name="scheduling monitor", daemon=True).start()
    try:
        yield
    finally:
        over.set()
        student.record_waiting()


def _sleep(log: ArenaLog, over: threading.Event) -> None:
    """Sleep again and again, and record each new longest delay."""
    worst = 0.0
    while not over.is_set():
        before = time.monotonic()
        time.sleep(PERIOD)
        late = time.monotonic() - before - PERIOD
        if late > worst:
            worst = late
            log.append(ev.WokenLate(late=late))
