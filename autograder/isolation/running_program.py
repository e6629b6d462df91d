"""A student's started program as the arena sees it, however it was started."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
from contextlib import suppress

from autograder.isolation.bubblewrap import WRITABLE
from autograder.isolation.process_tree import descendants


class RunningProgram:
    """Streams, processes and exit status of a started program. After `close` no signal is sent to its process ids.

    The program leads its own session, and so a process group that it cannot leave.

    Attributes:
        stdin, stdout, stderr: the arena's ends of its streams.
        end_fd: readable when the program itself has ended.
    """

    def __init__(
        self, process: subprocess.Popen[bytes], main_pid: int, sandbox_init: int | None = None
    ) -> None:
        """Take over a child of the arena; in a sandbox, `process` is bwrap, and `sandbox_init` the id of its init."""
        assert process.stdin
        assert process.stdout
        assert process.stderr
        self.stdin, self.stdout, self.stderr = process.stdin, process.stdout, process.stderr
        self.end_fd = os.pidfd_open(process.pid)
        self._process = process
        self._main_pid = main_pid
        self._init = sandbox_init
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
            if self._is_closed:
                return
            # killing init makes the kernel end the whole sandbox
            below = [self._init] if self._init else descendants(self._process.pid)
            for pid in (*below, self._process.pid):
                with suppress(ProcessLookupError, PermissionError):
                    os.kill(pid, signal.SIGKILL)

    def close(self) -> int:
        """Wait for the end; returns the program's status, -n when signal n ended it."""
        self.end()
        with self._lock:
            self._is_closed = True
            os.close(self.end_fd)
            status = self._process.wait()
            return 128 - status if self._init and 128 < status <= 192 else status

    def processes(self) -> list[int]:
        """Return the ids of the program, or bwrap around it, and of all it started, each parent before its children."""
        return [self._process.pid, *descendants(self._process.pid)]

    def files(self) -> int:
        """Return the number of files, folders and links in the sandbox's own folders; 0 without a sandbox."""
        held = 0
        for folder in WRITABLE if self._init else ():
            with suppress(OSError):  # it ends just now
                state = os.statvfs(f"/proc/{self._init}/root{folder}")
                held += state.f_files - state.f_ffree
        return held
