"""The life of a process: when it began, what it printed when, and how it ended."""

from __future__ import annotations

import re
import signal
from collections.abc import Sequence
from dataclasses import dataclass

from lab.pictures.annotations import Mark
from lab.running.processes import Process

LOG_PREFIX = re.compile(r"^(\[\w+\]) \[[\d.]+\] \[[^\]]*\]: ")  # severity, time and logger of a ROS log line


@dataclass(frozen=True)
class Life:
    """A process from `began` to `ended` (None: it still runs), s of `time.monotonic()`, with what it printed.

    `end` says how it ended.
    """

    name: str
    began: float
    ended: float | None
    end: str
    lines: Sequence[Mark]

    @classmethod
    def of(cls, name: str, process: Process, *, was_stopped: bool) -> Life:
        """The life of a process so far; `was_stopped`: the notebook ended it."""
        return cls(
            name,
            process.began,
            process.ended(),
            _end(process.exit_status, was_stopped),
            [Mark(at, _printable(line)) for at, line in process.lines() if line.strip()],
        )


def _end(exit_status: int | None, was_stopped: bool) -> str:
    if exit_status is None:
        return "still runs"
    if exit_status == -signal.SIGKILL:
        return "killed"
    return "stopped" if was_stopped else f"exit status {exit_status}"


def _printable(line: str) -> str:
    """A line as a label: without the prefix of a log line and without unprintable characters."""
    letters = "".join(letter if letter.isprintable() else " " for letter in line)
    return LOG_PREFIX.sub(r"\1 ", " ".join(letters.split()))
