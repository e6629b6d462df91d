"""Child processes that survive an interrupted cell and never survive the kernel; what they printed when."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from typing import IO

import psutil

from lab.pictures.labels import Mark
from ros_runtime.workarounds import die_with_parent

KEPT_LINES = 2000  # of each stream
GRACE = 3.0  # s from SIGINT to SIGKILL
DRAIN_TIME = 1.0  # s to read what an ended process left in its pipe
LOG_PREFIX = re.compile(r"^(\[\w+\]) \[[\d.]+\] \[[^\]]*\]: ")  # severity, time and logger of a ROS log line

# The signal that `die_with_parent` asks for comes when the *thread* that started the child ends: this one never does.
_spawner = ThreadPoolExecutor(max_workers=1, thread_name_prefix="lab spawner")


class Process:
    """A Python program in a process session of its own, with its last output.

    In its own session it does not get the SIGINT of Jupyter's stop button; `die_with_parent` ends it together with the
    notebook's kernel. Its output includes stderr, unless `own_stderr` is set. `began`: s of `time.monotonic()`.
    """

    def __init__(self, arguments: Sequence[str], *, own_stderr: bool = False) -> None:
        self.began = time.monotonic()
        self._popen = _spawner.submit(_start, arguments, own_stderr).result()
        self._output = _LastLines(self._popen.stdout)
        self._errors = _LastLines(self._popen.stderr) if own_stderr else None

    @property
    def is_running(self) -> bool:
        """Whether it is still running."""
        return self._popen.poll() is None

    @property
    def exit_status(self) -> int | None:
        """None while it runs, -n when signal n ended it."""
        return self._popen.poll()

    def cpu_time(self) -> float:
        """Processor time used so far, in s, with a resolution of 0.01 s. The process must be running."""
        used = psutil.Process(self._popen.pid).cpu_times()
        return used.user + used.system

    def output(self) -> str:
        """The last 2000 lines of stdout and stderr, in the order in which they were written."""
        return self._text(self._output)

    def errors(self) -> str:
        """The last 2000 lines of stderr, if `own_stderr` is set."""
        return self._text(self._errors) if self._errors else ""

    def lines(self) -> list[tuple[float, str]]:
        """The lines of `output()` and `errors()`, each with the time (s, `time.monotonic()`) at which it arrived."""
        return sorted(line for stream in self._streams() for line in self._lines(stream))

    def ended(self) -> float | None:
        """When its output was closed (s, `time.monotonic()`), which is its end; None while it runs."""
        return None if self.is_running else max(stream.closed() for stream in self._streams())

    def wait(self, timeout: float) -> bool:
        """Wait for its end; return whether it ended within `timeout` s."""
        try:
            self._popen.wait(timeout)
        except subprocess.TimeoutExpired:
            return False
        return True

    def stop(self) -> bool:
        """Send SIGINT, then SIGKILL after 3 s. Returns whether SIGINT was enough."""
        self.send(signal.SIGINT)
        if self.wait(GRACE):
            return True
        self.kill()
        return False

    def kill(self) -> None:
        """Send SIGKILL to it and to all processes that it started, and wait for its end."""
        self.send(signal.SIGKILL)
        self._popen.wait()

    def send(self, signal_number: int) -> None:
        """Send a signal to it and to all processes that it started."""
        if self.is_running:
            with suppress(ProcessLookupError):
                os.killpg(self._popen.pid, signal_number)

    def _streams(self) -> list[_LastLines]:
        return [self._output, *([self._errors] if self._errors else [])]

    def _lines(self, stream: _LastLines) -> list[tuple[float, str]]:
        return stream.lines(complete=not self.is_running)

    def _text(self, stream: _LastLines) -> str:
        return "".join(line for _, line in self._lines(stream))


class _LastLines:
    """Reads a pipe to its end, in a thread, and keeps the last lines."""

    def __init__(self, pipe: IO[str] | None) -> None:
        assert pipe
        self._pipe = pipe
        self._lines: deque[tuple[float, str]] = deque(maxlen=KEPT_LINES)
        self._closed: float | None = None
        self._reader = threading.Thread(target=self._read, name="lab reader", daemon=True)
        self._reader.start()

    def lines(self, *, complete: bool) -> list[tuple[float, str]]:
        """The lines so far, each with the time at which it arrived.

        `complete`: the process has ended, so first read what is left in the pipe.
        """
        if complete:
            self._reader.join(DRAIN_TIME)
        return list(self._lines.copy())

    def closed(self) -> float:
        """When the pipe was closed; now, if a child of the ended process still holds it."""
        self._reader.join(DRAIN_TIME)
        return time.monotonic() if self._closed is None else self._closed

    def _read(self) -> None:
        for line in self._pipe:
            self._lines.append((time.monotonic(), line))
        self._closed = time.monotonic()


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


def _start(arguments: Sequence[str], own_stderr: bool) -> subprocess.Popen[str]:
    # -I and -S: it needs no site-packages, whose start-up files would only cost time.
    with_us = [sys.executable, "-I", "-S", die_with_parent.__file__, str(os.getpid()), sys.executable]
    return subprocess.Popen(
        [*with_us, *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE if own_stderr else subprocess.STDOUT,
        start_new_session=True,
        encoding="utf-8",
        errors="replace",
    )
