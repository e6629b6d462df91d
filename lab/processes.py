"""Child processes that survive an interrupted cell and never survive the kernel."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

LEASH = Path(__file__).with_name("leash.py")
KEPT_LINES = 2000
LAST_WORDS = 1.0  # s for what an ended process still has in its pipe

# The signal that the leash asks for comes when the *thread* that started the child ends: this one never does.
_spawner = ThreadPoolExecutor(max_workers=1, thread_name_prefix="lab spawner")


class Process:
    """A running Python program in a session of its own, with its last output.

    The session keeps the SIGINT of Jupyter's stop button away from it; the leash ends it with the kernel.
    """

    def __init__(self, arguments: Sequence[str]) -> None:
        self._lines: deque[str] = deque(maxlen=KEPT_LINES)
        self._popen = _spawner.submit(_start, arguments).result()
        self._reader = threading.Thread(target=self._read, name="lab reader", daemon=True)
        self._reader.start()

    @property
    def is_running(self) -> bool:
        """Whether it has not ended yet."""
        return self._popen.poll() is None

    @property
    def exit_status(self) -> int | None:
        """None while it runs, -n when signal n ended it."""
        return self._popen.poll()

    def output(self) -> str:
        """What it printed, stdout and stderr as they came; the last 2000 lines."""
        if not self.is_running:
            self._reader.join(LAST_WORDS)
        return "".join(self._lines.copy())

    def stop(self, grace: float = 3.0) -> bool:
        """Ctrl-C, then SIGKILL after `grace` s. Returns whether Ctrl-C was enough."""
        self.send(signal.SIGINT)
        try:
            self._popen.wait(grace)
        except subprocess.TimeoutExpired:
            self.kill()
            return False
        return True

    def kill(self) -> None:
        """SIGKILL for it and all that it started, and wait until it is gone."""
        self.send(signal.SIGKILL)
        self._popen.wait()

    def send(self, signal_number: int) -> None:
        """Send a signal to it and all that it started."""
        if self.is_running:
            with suppress(ProcessLookupError):
                os.killpg(self._popen.pid, signal_number)

    def _read(self) -> None:
        assert self._popen.stdout
        for line in self._popen.stdout:
            self._lines.append(line)


def _start(arguments: Sequence[str]) -> subprocess.Popen[str]:
    # -I and -S: the leash needs no site-packages, whose start-up files would only cost time.
    leash = [sys.executable, "-I", "-S", str(LEASH), str(os.getpid()), sys.executable]
    return subprocess.Popen(
        [*leash, *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        start_new_session=True,
        encoding="utf-8",
        errors="replace",
    )
