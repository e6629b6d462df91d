"""When, where and with how much processor time a submission was graded; no grade depends on it."""

from __future__ import annotations

import socket
from dataclasses import dataclass
from datetime import datetime, timezone


@dataclass(frozen=True)
class Effort:
    """What grading one submission took.

    Attributes:
        began, ended: UTC, ISO 8601.
        host: the machine's name.
        processor_seconds: of all processes of its arenas, as far as they could be seen from outside.
        arenas: how many were opened.
        scenarios: how many runs they made, retries included.
    """

    began: str
    ended: str
    host: str
    processor_seconds: float = 0.0
    arenas: int = 0
    scenarios: int = 0


def without_arena() -> Effort:
    """Return the effort of what is decided here and now, such as an essay that waits for a person."""
    now = utc_now()
    return Effort(now, now, socket.gethostname())


def utc_now() -> str:
    """Return the time of day, UTC, ISO 8601."""
    return datetime.now(timezone.utc).isoformat(timespec="seconds")
