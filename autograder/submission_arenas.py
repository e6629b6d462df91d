"""The arenas of one submission: as many as scenarios run at a time, opened when they are needed."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType

from autograder.exercise import Exercise
from autograder.isolation.arena_process import Kind
from autograder.submission_arena import SubmissionArena


class SubmissionArenas:
    """A context manager; what it has opened ends with it.

    Where there are no namespaces an arena serves one scenario: what is left of it cannot be told from the next.
    """

    def __init__(self, exercise: Exercise, kind: Kind | None = None) -> None:
        self._exercise = exercise
        self._kind = kind
        self._idle: list[SubmissionArena] = []
        self._lock = threading.Lock()

    def __enter__(self) -> SubmissionArenas:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for arena in self._idle:
            arena.close()
        self._idle.clear()

    @contextmanager
    def one(self) -> Iterator[SubmissionArena]:
        """Lend an arena that nobody uses; after an exception it is closed and not used again."""
        arena = self._take() or SubmissionArena(self._exercise, self._kind)
        try:
            yield arena
        except BaseException:
            arena.close()
            raise
        if arena.kind is Kind.NAMESPACES:
            with self._lock:
                self._idle.append(arena)
        else:
            arena.close()

    def _take(self) -> SubmissionArena | None:
        with self._lock:
            return self._idle.pop() if self._idle else None
