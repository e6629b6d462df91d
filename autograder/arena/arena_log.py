"""The log of a scenario: every event goes to the pipe that the controller reads, and the stage waits for events here.

What students send is bounded: the number of events of a kind, the length of a text, the size of an event, and the size
of all events together. Events beyond these limits are counted, and `ArenaLog.finish` records the counts.
"""

from __future__ import annotations

import os
import threading
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from autograder.arena import events as ev
from ros_runtime.record.event import Event, as_line, to_json
from ros_runtime.record.event_log import EventLog
from ros_runtime.recorded_client.conversation import UNKNOWN_GOAL

MOST_OF_A_KIND = 5000  # events of one kind for one goal, call, …; far more than a correct node sends
MOST_OF: Mapping[str, int] = {
    ev.FeedbackReceived.kind: 1000,  # of one goal: 50 a second for the longest walk, ten times the required rate
    ev.RequestReceived.kind: 500,  # of one service; each may stay pending
    ev.GoalReceived.kind: 500,  # of one action
    ev.CancelReceived.kind: 500,
    ev.ResultRequested.kind: 500,  # of one goal
}
MAX_LENGTH = 10_000  # characters of a text, elements of a list
LARGEST_EVENT = 2**20  # bytes of JSON
LARGEST_RECORD = 32 * 2**20  # bytes of events that students cause; the controller reads up to twice as many
MOST_UNMATCHED = 500  # events of one kind that match no goal, call or service of the scenario


@dataclass
class _Dropped:
    """Dropped events of one kind: their number, and the times (s) of the first event and of the last dropped one."""

    count: int
    since: float
    until: float


class ArenaLog(EventLog):
    """Writes each event as one JSON object a line to `fd`; safe to use from any thread."""

    def __init__(self, fd: int) -> None:
        super().__init__()
        self._fd = fd
        self._writing = threading.Lock()
        self._counting = threading.Lock()
        self._counts: Counter[tuple[str, str]] = Counter()
        self._first: dict[str, float] = {}
        self._dropped: dict[str, _Dropped] = {}
        self._bytes = 0

    def append(self, event: Event) -> None:
        """Write an event, and wake up the threads that wait for it."""
        cut: list[int] = []
        line = as_line(event.kind, {name: _cut(value, cut) for name, value in to_json(event).items()})
        if len(line) > LARGEST_EVENT:
            self.too_large(event.kind, "", len(line), LARGEST_EVENT)
            return
        with self._counting:
            self._bytes += len(line)
        self.append_written(event, line)
        if cut:
            self.too_large(event.kind, "", max(cut), MAX_LENGTH)

    def append_written(self, event: Event, line: bytes) -> None:
        """Append an event that another trusted process has already written as a line."""
        with self._writing:
            while line:
                line = line[os.write(self._fd, line) :]
        super().append(event)

    def admits(self, what: str, of: str) -> bool:
        """Return whether to record one more event of a kind; call it once for each event caused by the student.

        An event that is not admitted counts as dropped.

        Args:
            what: the kind of event.
            of: the goal, call or service it belongs to, or UNKNOWN_GOAL. Each has a limit of its own, so that a flood
                for one displaces no event of another.
        """
        now = time.monotonic()
        with self._counting:
            self._first.setdefault(what, now)
            self._counts[what, of] += 1
            most = MOST_UNMATCHED if of == UNKNOWN_GOAL else MOST_OF.get(what, MOST_OF_A_KIND)
            admitted = self._counts[what, of] <= most and self._bytes < LARGEST_RECORD
        if not admitted:
            self.drop(what)
        return admitted

    @property
    def received(self) -> int:
        """Number of events that the student's processes have caused so far, recorded or not."""
        with self._counting:
            return self._counts.total()

    def drop(self, what: str) -> None:
        """Count an event that is not recorded."""
        now = time.monotonic()
        with self._counting:
            since = self._first.setdefault(what, now)
            dropped = self._dropped.setdefault(what, _Dropped(0, since, now))
            dropped.count += 1
            dropped.until = now

    def too_large(self, what: str, id: str, size: int, limit: int) -> None:
        """Record that a message or event exceeded its size limit (bytes)."""
        if self.admits(ev.TooLarge.kind, what):
            self.append(ev.TooLarge(what=what, id=id, bytes=size, limit=limit))

    def finish(self) -> None:
        """Record how many events were dropped: one RecordDropped for each kind."""
        with self._counting:
            dropped, self._dropped = self._dropped, {}
        for what, each in dropped.items():
            self.append(ev.RecordDropped(what=what, count=each.count, seconds=each.until - each.since))


def _cut(value: Any, cut: list[int]) -> Any:
    """Return a value with its texts and lists cut to MAX_LENGTH; `cut` gets the length of each that was longer."""
    if isinstance(value, dict):
        return {name: _cut(each, cut) for name, each in value.items()}
    if isinstance(value, str | list | tuple) and len(value) > MAX_LENGTH:
        cut.append(len(value))
        # a list becomes empty, because a marker of another type would not fit the field
        value = f"{value[:MAX_LENGTH]}…[cut: {len(value):,} characters]" if isinstance(value, str) else []
    if isinstance(value, list | tuple):
        return [_cut(each, cut) for each in value]
    if isinstance(value, str) and not value.isascii():
        return value.encode(errors="replace").decode()  # JSON parsers refuse an unpaired surrogate
    return value
