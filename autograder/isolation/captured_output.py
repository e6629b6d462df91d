"""Captures the output of untrusted processes line by line, with times, up to a limit."""

from __future__ import annotations

import os
import selectors
import time
from collections.abc import Callable, Mapping
from typing import NamedTuple

_READ_BYTES = 65536
_LONGEST_LINE = 4096  # characters; a longer one is continued on the next line
_SHORTEST_COST = 32  # bytes that each line counts at least, because even an empty one uses memory


class OutputLine(NamedTuple):
    """One line as it arrived: the reader's `time.monotonic()` in s, and the text without its end."""

    time: float
    text: str


class CapturedOutput:
    """The lines of one stream. Output beyond the limit is counted and dropped; a last line says so."""

    def __init__(self, limit_kib: int, on_line: Callable[[OutputLine], object] | None = None) -> None:
        self._limit = limit_kib * 1024
        self._limit_kib = limit_kib
        self._on_line = on_line
        self._lines: list[OutputLine] = []
        self._unfinished = b""
        self._cost = 0
        self.dropped_bytes = 0

    @property
    def lines(self) -> list[OutputLine]:
        """The lines so far."""
        return list(self._lines)

    @property
    def text(self) -> str:
        """The lines so far as one string."""
        return "".join(f"{line.text}\n" for line in self._lines)

    def feed(self, data: bytes) -> None:
        """Add bytes that have just been read."""
        now = time.monotonic()
        if self._cost >= self._limit:
            self.dropped_bytes += len(data)
            return
        *complete, self._unfinished = (self._unfinished + data).split(b"\n")
        for line in complete:
            self._keep(now, line)
        while len(self._unfinished) > _LONGEST_LINE:
            line, self._unfinished = self._unfinished[:_LONGEST_LINE], self._unfinished[_LONGEST_LINE:]
            self._keep(now, line)

    def close(self) -> None:
        """Note the end of the stream: keep an unfinished last line, and add a line on what was dropped."""
        if self._unfinished:
            self._keep(time.monotonic(), self._unfinished)
            self._unfinished = b""
        if self.dropped_bytes:
            note = (
                f"[cut after {self._limit_kib} KiB of output; {self.dropped_bytes} more bytes are not shown]"
            )
            self._append(OutputLine(time.monotonic(), note))

    def _keep(self, now: float, line: bytes) -> None:
        if self._cost >= self._limit:
            self.dropped_bytes += len(line) + 1
            return
        for start in range(0, len(line) or 1, _LONGEST_LINE):
            part = line[start : start + _LONGEST_LINE]
            self._cost += max(len(part) + 1, _SHORTEST_COST)
            self._append(OutputLine(now, part.decode(errors="replace")))

    def _append(self, line: OutputLine) -> None:
        self._lines.append(line)
        if self._on_line:
            self._on_line(line)


class OutputPump:
    """Reads several streams at once until every writer has closed them."""

    def __init__(self, streams: Mapping[int, CapturedOutput]) -> None:
        self._selector = selectors.DefaultSelector()
        self._open = dict(streams)
        for fd in streams:
            self._selector.register(fd, selectors.EVENT_READ)

    def watch(self, fd: int) -> None:
        """Also wake up from `poll` when this descriptor becomes readable."""
        self._selector.register(fd, selectors.EVENT_READ)

    def poll(self, timeout: float) -> set[int]:
        """Read what there is, waiting up to `timeout` s; returns the watched descriptors that are ready."""
        ready = {key.fd for key, _ in self._selector.select(timeout)}
        streams = ready & self._open.keys()
        for fd in streams:
            data = os.read(fd, _READ_BYTES)
            if data:
                self._open[fd].feed(data)
            else:
                self._selector.unregister(fd)
                self._open.pop(fd).close()
        return ready - streams

    def finish(self, timeout: float) -> None:
        """Read until the streams end, at most `timeout` s: an escaped process may keep them open."""
        # descriptors that are always ready would cause a busy loop
        for fd in set(self._selector.get_map()) - self._open.keys():
            self._selector.unregister(fd)
        deadline = time.monotonic() + timeout
        while self._open and (left := deadline - time.monotonic()) > 0:
            self.poll(left)
        for capture in self._open.values():
            capture.close()
        self._open.clear()
        self._selector.close()
