"""Arenas for known submissions of several exercises that are graded side by side."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from autograder.classroom.audit.known_submission import KnownSubmission
from autograder.engine.exercise import Exercise
from autograder.engine.submission_arenas import SubmissionArenas


class SharedArenas:
    """Lends an exercise's arenas to one faulty submission after another, and closes them after the last one.

    As a context manager, it closes the arenas that are still open.
    """

    def __init__(self, submissions: Iterable[KnownSubmission]) -> None:
        """Each of `submissions` will be graded once."""
        self._left = Counter(known.exercise for known in submissions if known.kind == "faulty")
        self._open: dict[str, SubmissionArenas] = {}
        self._lock = threading.Lock()

    def __enter__(self) -> SharedArenas:
        return self

    def __exit__(self, *_: object) -> None:
        for arenas in self._open.values():
            arenas.close()

    @contextmanager
    def lent_to(self, known: KnownSubmission, exercise: Exercise) -> Iterator[SubmissionArenas | None]:
        """Yield the shared arenas for a faulty submission; None for any other, which needs arenas of its own."""
        if known.kind != "faulty":
            yield None
            return
        with self._lock:
            arenas = self._open.setdefault(known.exercise, SubmissionArenas(exercise.scenario_file))
        try:
            yield arenas
        finally:
            with self._lock:
                self._left[known.exercise] -= 1
                last = not self._left[known.exercise]
            if last:
                arenas.close()
