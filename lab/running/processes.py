"""Child processes that survive the interrupt of a cell but not the end of the kernel, and their output with times."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import deque
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from typing import IO

from lab.pictures.labels import Mark
from ros_runtime.workarounds import die_with_parent
from ros_runtime.workarounds.rclpy_repairs.hook import STACK_FILE, STACK_SIGNAL

KEPT_LINES = 2000  # of each output stream
GRACE = 3.0  # s from SIGINT to SIGKILL
DRAIN_TIME = 1.0  # s to read the rest of the pipe of a process that has ended
STACK_TIMEOUT = 0.5  # s for the process to begin to write its stacks
STACK_TIME = 0.05  # s to write them
LOG_PREFIX = re.compile(r"^(\[\w+\]) \[[\d.]+\] \[[^\]]*\]: ")  # severity, time and logger of a ROS log line

# Linux sends the signal of `die_with_parent` when the *thread* that started the child ends; this thread never ends.
_spawner = ThreadPoolExecutor(max_workers=1, thread_name_prefix="lab spawner")


class Process:
    """A Python program in a process session of its own, with its last output.

    Because of the session it does not receive the SIGINT of Jupyter's stop button. `die_with_parent` ends it when the
    notebook's kernel ends. Its output includes stderr, unless `own_stderr` is set. `began` is its start, in s of
    `time.monotonic()`.
    """

    def __init__(self, arguments: Sequence[str], *, own_stderr: bool = False) -> None:
        self.began = time.monotonic()
        self._stacks = tempfile.TemporaryFile()  # noqa: SIM115  # closed with this object
        self._popen = _spawner.submit(_start, arguments, own_stderr, self._stacks.fileno()).result()
        self._output = _LastLines(self._popen.stdout)
        self._errors = _LastLines(self._popen.stderr) if own_stderr else None

    @property
    def pid(self) -> int:
        """The id of the process and of its group."""
        return self._popen.pid

    @property
    def is_running(self) -> bool:
        """Whether the process is still running."""
        return self._popen.poll() is None

    @property
    def exit_status(self) -> int | None:
        """None while the process runs; -n if signal n ended it."""
        return self._popen.poll()

    def output(self) -> str:
        """Return the last 2000 lines of stdout and, unless `own_stderr` is set, of stderr, in the order of writing."""
        return self._text(self._output)

    def errors(self) -> str:
        """Return the last 2000 lines of stderr if `own_stderr` is set."""
        return self._text(self._errors) if self._errors else ""

    def lines(self) -> list[tuple[float, str]]:
        """Return the lines of `output()` and `errors()`, each with its time of arrival (s, `time.monotonic()`)."""
        return sorted(line for stream in self._streams() for line in self._lines(stream))

    def ended(self) -> float | None:
        """Return when the process ended and closed its output (s, `time.monotonic()`); None while it runs."""
        return None if self.is_running else max(stream.closed() for stream in self._streams())

    def stacks(self) -> list[str]:
        """Return the stacks of the threads of the running process as faulthandler prints them; the process goes on."""
        self._stacks.truncate(0)
        self._stacks.seek(0)  # for the process, too
        with suppress(ProcessLookupError):
            os.kill(self._popen.pid, STACK_SIGNAL)
        end = time.monotonic() + STACK_TIMEOUT
        while time.monotonic() < end and not os.fstat(self._stacks.fileno()).st_size:
            time.sleep(STACK_TIME)
        time.sleep(STACK_TIME)
        self._stacks.seek(0)
        return self._stacks.read().decode(errors="replace").splitlines()

    def wait(self, timeout: float) -> bool:
        """Wait until the process ends; return whether it ended within `timeout` s."""
        try:
            self._popen.wait(timeout)
        except subprocess.TimeoutExpired:
            return False
        return True

    def stop(self) -> bool:
        """Send SIGINT, and SIGKILL if the process still runs after 3 s; return whether SIGINT was enough."""
        self.send(signal.SIGINT)
        if self.wait(GRACE):
            return True
        self.kill()
        return False

    def kill(self) -> None:
        """Send SIGKILL to the process and to all processes that it started, and wait for its end."""
        self.send(signal.SIGKILL)
        self._popen.wait()

    def send(self, signal_number: int) -> None:
        """Send a signal to the process and to all processes that it started."""
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
    """Reads a pipe to its end in a thread, and keeps the last lines."""

    def __init__(self, pipe: IO[str] | None) -> None:
        assert pipe
        self._pipe = pipe
        self._lines: deque[tuple[float, str]] = deque(maxlen=KEPT_LINES)
        self._closed: float | None = None
        self._reader = threading.Thread(target=self._read, name="lab reader", daemon=True)
        self._reader.start()

    def lines(self, *, complete: bool) -> list[tuple[float, str]]:
        """Return the lines so far, each with its time of arrival.

        `complete` means that the process has ended, so the rest of the pipe is read first.
        """
        if complete:
            self._reader.join(DRAIN_TIME)
        return list(self._lines.copy())

    def closed(self) -> float:
        """Return when the pipe was closed; the current time, if a child of the ended process still has it open."""
        self._reader.join(DRAIN_TIME)
        return time.monotonic() if self._closed is None else self._closed

    def _read(self) -> None:
        for line in self._pipe:
            self._lines.append((time.monotonic(), line))
        self._closed = time.monotonic()


@dataclass(frozen=True)
class ProcessHistory:
    """What a process has done, for pictures: when it began and ended, how it ended, and what it printed.

    Times are in s of `time.monotonic()`. `ended` is None if it still runs. `end` describes how it ended.
    """

    name: str
    began: float
    ended: float | None
    end: str
    lines: Sequence[Mark]

    @classmethod
    def of(cls, name: str, process: Process, *, was_stopped: bool) -> ProcessHistory:
        """Return the history of a process so far; `was_stopped` is whether the notebook stopped it."""
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
    """Return a line as a label: without the time and logger of a log message, and without unprintable characters."""
    letters = "".join(letter if letter.isprintable() else " " for letter in line)
    return LOG_PREFIX.sub(r"\1 ", " ".join(letters.split()))


def _start(arguments: Sequence[str], own_stderr: bool, stacks: int) -> subprocess.Popen[str]:
    # die_with_parent needs no site-packages; -I and -S skip their start-up files, which cost time.
    with_us = [sys.executable, "-I", "-S", die_with_parent.__file__, str(os.getpid()), sys.executable]
    return subprocess.Popen(
        [*with_us, *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE if own_stderr else subprocess.STDOUT,
        start_new_session=True,
        env={**os.environ, STACK_FILE: str(stacks)},
        pass_fds=[stacks],
        encoding="utf-8",
        errors="replace",
    )
