"""A request to stop, passed from a batch to the gradings and arenas in it."""

from __future__ import annotations

import threading


class Stopped(Exception):
    """Grading was ended on request; there is no grade."""


class Stop:
    """A flag that stays set. A child (`Stop(above)`) counts as set when its parent is; its own flag does not."""

    def __init__(self, above: Stop | None = None) -> None:
        self._above = above
        self._event = threading.Event()

    def set(self) -> None:
        """Request the stop."""
        self._event.set()

    def is_set(self) -> bool:
        """Whether this stop or its parent was set."""
        return self._event.is_set() or (self._above is not None and self._above.is_set())
