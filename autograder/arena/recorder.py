"""Writes events, one JSON object a line, to the pipe the controller reads.

What students send is bounded here: how many events of a kind are kept, how long a text and how large an event may be,
and how much all of them together. What is not kept is counted, and :meth:`Recorder.finish` says so.
"""

from __future__ import annotations

import json
import os
import threading
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from autograder.arena.long_texts import cut_long_texts

MOST_OF_A_KIND = 5000  # events of one kind for one goal, call, …; no sound node comes near
MOST_OF: Mapping[str, int] = {
    "feedback": 1000,  # of one goal: 50 a second for the longest walk, ten times what is asked for
    "request_received": 500,  # of one service: each may be waited for
}
LARGEST_EVENT = 2**20  # bytes of JSON
LARGEST_RECORD = 32 * 2**20  # bytes of what students send; the controller reads twice as much
NOBODYS = "nobody's"  # what belongs to no goal of the scenario's is counted together
MOST_OF_NOBODYS = 500  # such events of one kind


@dataclass
class _Dropped:
    """Events of one kind that were not kept; `since` and `until` are s."""

    count: int
    since: float
    until: float


class Recorder:
    """Safe to use from any thread; the types of events are those of :mod:`autograder.authoring.events`."""

    def __init__(self, fd: int) -> None:
        self._fd = fd
        self._writing = threading.Lock()
        self._counting = threading.Lock()
        self._counts: Counter[tuple[str, str]] = Counter()
        self._first: dict[str, float] = {}
        self._dropped: dict[str, _Dropped] = {}
        self._bytes = 0

    def admits(self, kind: str, of: str) -> bool:
        """Whether one more event of a kind that the student's processes cause is to be recorded; asked once for each.

        `of` is the goal, call or service it belongs to, or NOBODYS: each has a number of its own, so that a flood of
        one pushes out nothing of another. An event that is not admitted counts as dropped.
        """
        now = time.monotonic()
        with self._counting:
            self._first.setdefault(kind, now)
            self._counts[kind, of] += 1
            most = MOST_OF_NOBODYS if of == NOBODYS else MOST_OF.get(kind, MOST_OF_A_KIND)
            admitted = self._counts[kind, of] <= most and self._bytes < LARGEST_RECORD
        if not admitted:
            self.drop(kind)
        return admitted

    @property
    def received(self) -> int:
        """How many events of the student's processes there were so far, recorded or not."""
        with self._counting:
            return self._counts.total()

    def drop(self, kind: str) -> None:
        """Count an event that is not recorded."""
        now = time.monotonic()
        with self._counting:
            since = self._first.setdefault(kind, now)
            dropped = self._dropped.setdefault(kind, _Dropped(0, since, now))
            dropped.count += 1
            dropped.until = now

    def record(self, kind: str, *, t: float | None = None, **fields: Any) -> None:
        """Write an event that happened now, or at `t` (s, `time.monotonic()`)."""
        t = time.monotonic() if t is None else t
        shortened, longest = cut_long_texts(fields)
        line = _as_line(t, kind, shortened)
        if len(line) > LARGEST_EVENT:
            self.too_large(kind, "", len(line), LARGEST_EVENT)
            return
        with self._counting:
            self._bytes += len(line)
        self.forward(line)
        if longest.was_cut:
            self.too_large(kind, "", longest.length, longest.limit)

    def too_large(self, what: str, id: str, size: int, limit: int) -> None:
        """Record that something had more bytes than are read."""
        if self.admits("too_large", what):
            self.record("too_large", what=what, id=id, bytes=size, limit=limit)

    def finish(self) -> None:
        """Record what was dropped, an event a kind."""
        with self._counting:
            dropped, self._dropped = self._dropped, {}
        for kind, each in dropped.items():
            self.record("dropped", what=kind, count=each.count, seconds=each.until - each.since)

    def forward(self, line: bytes) -> None:
        """Write a line that another trusted process has already put into this form."""
        with self._writing:
            while line:
                line = line[os.write(self._fd, line) :]


def _as_line(t: float, kind: str, fields: Mapping[str, Any]) -> bytes:
    return json.dumps({"t": t, "kind": kind, **fields}).encode() + b"\n"
