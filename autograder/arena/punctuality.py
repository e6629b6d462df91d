"""How late the arena's own processes are woken: what the machine takes from everybody who keeps a deadline there."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from autograder.arena.recorder import Recorder

PERIOD = 0.1  # s on the arena's clock


@contextmanager
def punctuality(recorder: Recorder) -> Iterator[None]:
    """Sleep over and over beside the scenario, and record each sleep that was longer than any before by how much."""
    over = threading.Event()
    watch = threading.Thread(target=_watch, args=(recorder, over), name="punctuality", daemon=True)
    watch.start()
    try:
        yield
    finally:
        over.set()


def _watch(recorder: Recorder, over: threading.Event) -> None:
    worst = 0.0
    while not over.is_set():
        before = time.monotonic()
        time.sleep(PERIOD)
        late = time.monotonic() - before - PERIOD
        if late > worst:
            worst = late
            recorder.record("woken_late", late=late)
