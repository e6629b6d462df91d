"""The arenas of one submission: one for each scenario that runs at a time, opened when needed."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from autograder.engine.submission_arena import SubmissionArena
from autograder.isolation.arena_spec import ISOLATION_VARIABLE, Kind
from autograder.isolation.availability import available_isolation
from autograder.isolation.bubblewrap import SandboxError


@dataclass(frozen=True)
class ArenasUsed:
    """What the closed arenas of a submission cost together."""

    arenas: int = 0
    scenarios: int = 0
    processor_seconds: float = 0.0


class SubmissionArenas:
    """A pool of arenas as a context manager, which closes all arenas it has opened.

    Without namespaces an arena serves one scenario, because leftovers of one scenario could disturb the next.
    """

    def __init__(self, scenario_file: Path, kind: Kind | None = None) -> None:
        self._scenario_file = scenario_file
        self._kind = kind
        self._idle: list[SubmissionArena] = []
        self._ahead: Future[SubmissionArena] | None = None
        self._lock = threading.Lock()
        self._used = ArenasUsed()

    def open_ahead(self) -> None:
        """Begin to open an isolated arena in the background; do nothing if isolation is switched off."""
        if os.environ.get(ISOLATION_VARIABLE) in (Kind.NONE, Kind.ANOTHER_USER):
            return
        with ThreadPoolExecutor(1) as pool:
            self._ahead = pool.submit(SubmissionArena, self._scenario_file, Kind.NAMESPACES)
            pool.shutdown(wait=False)

    def __enter__(self) -> SubmissionArenas:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close all arenas that are open."""
        self._take_the_one_ahead()
        for arena in self._idle:
            self._close(arena)
        self._idle.clear()

    @property
    def used(self) -> ArenasUsed:
        """What the arenas that are closed by now have cost."""
        return self._used

    @contextmanager
    def one(self) -> Iterator[SubmissionArena]:
        """Lend an idle arena; after an exception it is closed and not used again."""
        arena = self._take() or SubmissionArena(self._scenario_file, self._kind or available_isolation().kind)
        try:
            yield arena
        except BaseException:
            self._close(arena)
            raise
        if arena.kind is Kind.NAMESPACES:
            with self._lock:
                self._idle.append(arena)
        else:
            self._close(arena)

    def _take(self) -> SubmissionArena | None:
        if self._kind in (None, Kind.NAMESPACES):
            self._take_the_one_ahead()
        with self._lock:
            return self._idle.pop() if self._idle else None

    def _take_the_one_ahead(self) -> None:
        """Wait for the arena that is being opened in the background; if that fails, opening the next one will raise."""
        with self._lock, suppress(SandboxError):
            ahead, self._ahead = self._ahead, None
            if ahead:
                self._idle.append(ahead.result())

    def _close(self, arena: SubmissionArena) -> None:
        report = arena.close()
        with self._lock:
            self._used = ArenasUsed(
                self._used.arenas + 1,
                self._used.scenarios + arena.scenarios,
                self._used.processor_seconds + report.processor_seconds,
            )
