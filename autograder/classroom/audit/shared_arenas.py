"""Arenas that the faulty submissions of an exercise share in an audit: opening one costs more than most scenarios.

No student's grade comes from them. Correct and hostile submissions get arenas of their own, as students' do.
"""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from types import TracebackType

from autograder.classroom.audit.known_submission import KnownSubmission
from autograder.engine.exercise import Exercise
from autograder.engine.submission_arenas import SubmissionArenas


class SharedArenas:
    """Lends arenas to one faulty submission after another; those of an exercise are closed after its last.

    A context manager, which closes what is still open.
    """

    def __init__(self, submissions: Iterable[KnownSubmission]) -> None:
        """Each of `submissions` will be graded once."""
        self._left = Counter(known.exercise for known in submissions if known.kind == "faulty")
        self._open: dict[str, _KeptArenas] = {}
        self._lock = threading.Lock()

    def __enter__(self) -> SharedArenas:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for arenas in self._open.values():
            arenas.close()

    @contextmanager
    def lent_to(self, known: KnownSubmission, exercise: Exercise) -> Iterator[SubmissionArenas | None]:
        """Yield the shared arenas for a faulty submission; None for any other, which needs its own."""
        if known.kind != "faulty":
            yield None
            return
        with self._lock:
            arenas = self._open.setdefault(known.exercise, _KeptArenas(exercise.scenario_file))
        try:
            yield arenas
        finally:
            with self._lock:
                self._left[known.exercise] -= 1
                last = not self._left[known.exercise]
            if last:
                arenas.close()


class _KeptArenas(SubmissionArenas):
    """Arenas that stay open from one grading to the next."""

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Leave them open for the next grading."""
