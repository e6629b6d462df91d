"""A request to end what runs, handed down from a batch to the arenas of its submissions."""

from __future__ import annotations

import threading


class Stopped(Exception):
    """Grading was ended on request; there is no grade."""


class Stop:
    """Once set, it stays set. A stop below another is set with it, and can be set alone."""

    def __init__(self, above: Stop | None = None) -> None:
        self._above = above
        self._event = threading.Event()

    def set(self) -> None:
        """Ask for the end."""
        self._event.set()

    def is_set(self) -> bool:
        """Whether the end was asked for, here or above."""
        return self._event.is_set() or (self._above is not None and self._above.is_set())
