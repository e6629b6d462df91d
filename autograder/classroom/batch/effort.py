"""When, where and with how much processor time a submission was graded; no grade depends on it."""

from __future__ import annotations

import socket
from dataclasses import dataclass
from datetime import datetime, timezone


@dataclass(frozen=True)
class Effort:
    """Time, place and cost of grading one submission.

    Attributes:
        began, ended: UTC, ISO 8601.
        host: the machine's name.
        processor_seconds: of all processes in its arenas; sampled, so the last moments of killed processes are missing.
        arenas: number of arenas opened.
        scenarios: number of scenario runs, including retries.
    """

    began: str
    ended: str
    host: str
    processor_seconds: float = 0.0
    arenas: int = 0
    scenarios: int = 0


def without_arena() -> Effort:
    """Return the effort of a grade that needs no arena, such as an unmarked essay."""
    now = utc_now()
    return Effort(now, now, socket.gethostname())


def utc_now() -> str:
    """Return the present date and time, UTC, ISO 8601."""
    return datetime.now(timezone.utc).isoformat(timespec="seconds")
