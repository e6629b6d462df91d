"""A scenario's log whose output is discarded."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from autograder.arena.arena_log import ArenaLog


@pytest.fixture
def log() -> Iterator[ArenaLog]:
    """A log whose events a test can read."""
    fd = os.open(os.devnull, os.O_WRONLY)
    yield ArenaLog(fd)
    os.close(fd)
