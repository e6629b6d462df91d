"""A student's started program as the arena sees it, however it was started."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
from contextlib import suppress
from typing import IO

from autograder.isolation.bubblewrap import WRITABLE, StartedSandbox
from autograder.isolation.process_tree import descendants


class RunningProgram:
    """Streams, processes and exit status of a started program. After `close` no signal is sent to its process ids.

    The program leads its own session, and so a process group that it cannot leave.

    Attributes:
        stdin, stdout, stderr: the arena's ends of its streams.
        end_fd: readable when the program itself has ended.
    """

    def __init__(self, streams: tuple[IO[bytes], IO[bytes], IO[bytes]], main_pid: int, end_fd: int) -> None:
        self.stdin, self.stdout, self.stderr = streams
        self.end_fd = end_fd
        self._main_pid = main_pid
        self._lock = threading.Lock()
        self._is_closed = False

    def signal(self, number: signal.Signals) -> None:
        """Send a signal to the program alone."""
        with self._lock, suppress(ProcessLookupError):
            if not self._is_closed:
                os.kill(self._main_pid, number)

    def interrupt(self) -> None:
        """Send SIGINT to the program's process group, as a terminal does with its foreground group on Ctrl-C."""
        with self._lock, suppress(ProcessLookupError):
            if not self._is_closed:
                os.killpg(self._main_pid, signal.SIGINT)

    def end(self) -> None:
        """Kill the program and its descendants; does nothing if it has ended."""
        with self._lock:
            if not self._is_closed:
                self._kill_everything()

    def close(self) -> int:
        """Wait for the end; returns the program's status, -n when signal n ended it."""
        self.end()
        with self._lock:
            self._is_closed = True
            return self._status()

    def processes(self) -> list[int]:
        """Return the ids of the program and of everything it started, each parent before its children."""
        raise NotImplementedError

    def files(self) -> int:
        """Return the number of files in the program's writable folders; 0 without a private file system."""
        return 0

    def _kill_everything(self) -> None:
        raise NotImplementedError

    def _status(self) -> int:
        raise NotImplementedError


class ChildProgram(RunningProgram):
    """A program started as a child of the arena; in a sandbox, when `sandbox_init` is the process id of its init."""

    def __init__(
        self, process: subprocess.Popen[bytes], main_pid: int, sandbox_init: int | None = None
    ) -> None:
        assert process.stdin
        assert process.stdout
        assert process.stderr
        super().__init__(
            (process.stdin, process.stdout, process.stderr), main_pid, os.pidfd_open(process.pid)
        )
        self._process = process
        self._init = sandbox_init

    def files(self) -> int:
        """Return how many files there are in the sandbox's own folders."""
        return _files_in_memory(self._init) if self._init else 0

    def processes(self) -> list[int]:
        """Return the ids of its processes: the program, or bwrap around it, and all that descend from it."""
        return [self._process.pid, *descendants(self._process.pid)]

    def _kill_everything(self) -> None:
        # killing init makes the kernel end the whole sandbox
        below = [self._init] if self._init else descendants(self._process.pid)
        _kill(*below, self._process.pid)

    def _status(self) -> int:
        os.close(self.end_fd)
        status = self._process.wait()
        return 128 - status if self._init and 128 < status <= 192 else status


class EnteredProgram(RunningProgram):
    """A program that entered an empty sandbox. Its exit status is read from `report` after its end."""

    def __init__(
        self,
        streams: tuple[IO[bytes], IO[bytes], IO[bytes]],
        main_pid: int,
        report: IO[bytes],
        sandbox: StartedSandbox,
    ) -> None:
        super().__init__(streams, main_pid, report.fileno())
        self._report = report
        self._sandbox = sandbox

    def files(self) -> int:
        """Return how many files there are in the sandbox's own folders."""
        return _files_in_memory(self._sandbox.init_pid)

    def processes(self) -> list[int]:
        """Return the ids of its processes: the program, the init of its sandbox, and all that descend from them."""
        roots = (self._main_pid, self._sandbox.init_pid)
        return [*roots, *(pid for root in roots for pid in descendants(root))]

    def _kill_everything(self) -> None:
        _kill(self._sandbox.init_pid, self._sandbox.process.pid)

    def _status(self) -> int:
        status = self._report.readline()
        self._report.close()
        self._sandbox.process.communicate()
        return int(status) if status else -signal.SIGKILL


def _files_in_memory(process: int) -> int:
    """Return how many files, folders and links a sandbox's own file systems hold; `process` is one in it."""
    held = 0
    for folder in WRITABLE:
        with suppress(OSError):  # it ends just now
            state = os.statvfs(f"/proc/{process}/root{folder}")
            held += state.f_files - state.f_ffree
    return held


def _kill(*pids: int) -> None:
    for pid in pids:
        with suppress(ProcessLookupError, PermissionError):
            os.kill(pid, signal.SIGKILL)
