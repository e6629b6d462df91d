"""A scenario's log whose lines go nowhere."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from autograder.arena.arena_log import ArenaLog


@pytest.fixture
def log() -> Iterator[ArenaLog]:
    """A log of which a test sees the events."""
    fd = os.open(os.devnull, os.O_WRONLY)
    yield ArenaLog(fd)
    os.close(fd)
