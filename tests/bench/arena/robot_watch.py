"""Watches the simulator of an arena from outside, and measures the processor time it uses per second."""

from __future__ import annotations

import os
import threading
import time
from contextlib import suppress
from pathlib import Path

NAME = "robot_sim"  # what the simulator's process is called, or has in its command line
_CPU_CLOCK = 2  # the kernel's CPUCLOCK_SCHED: exact, unlike the ticks in /proc/PID/stat
_PERIOD = 0.05  # s
_LATER_PART = 0.6  # of what was seen: before that it starts and is looked for


class RobotWatch:
    """A context manager around one run; `cpu_per_second` is about the later part of it."""

    def __enter__(self) -> RobotWatch:
        self._samples: list[tuple[float, float]] = []
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()
        return self

    def __exit__(self, *_error: object) -> None:
        self._over.set()
        self._thread.join()

    def cpu_per_second(self) -> float | None:
        """Return the processor seconds it used per real second; None without a simulator, or after too short a run."""
        later = self._samples[round(len(self._samples) * (1 - _LATER_PART)) :]
        if len(later) < 4:
            return None
        (began, cpu_before), (ended, cpu_after) = later[0], later[-1]
        return (cpu_after - cpu_before) / (ended - began)

    def _watch(self) -> None:
        simulator = None
        while not self._over.wait(_PERIOD):
            simulator = simulator or _find()
            if simulator:
                with suppress(OSError):
                    used = time.clock_gettime((~simulator << 3) | _CPU_CLOCK)
                    self._samples.append((time.monotonic(), used))


def _find() -> int | None:
    """Return the process id of a simulator below this process."""
    waiting = [os.getpid()]
    while waiting:
        pid = waiting.pop()
        with suppress(OSError):
            if pid != os.getpid():
                process = Path("/proc", str(pid))
                if (
                    NAME in (process / "comm").read_text()
                    or f"-m\0{NAME}" in (process / "cmdline").read_text()
                ):
                    return pid
            for task in os.listdir(f"/proc/{pid}/task"):
                waiting += map(int, Path(f"/proc/{pid}/task/{task}/children").read_text().split())
    return None
