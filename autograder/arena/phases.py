"""Measures each phase of a scenario for `course bench --arena`: wall time, and processor time of the whole arena."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from ros_runtime.workarounds.scaled_clock.clock import real_monotonic_ns

if TYPE_CHECKING:  # the arena's first process measures before it imports
    from autograder.arena.arena_log import ArenaLog

_CPU_CLOCK = 2  # the kernel's CPUCLOCK_SCHED: exact, unlike the ticks in /proc/PID/stat

Phase = tuple[str, float, float]  # name, wall s, processor s


def since_start(name: str) -> Phase:
    """Return the phase from this process's start until now; its processor time includes processes started earlier."""
    with open("/proc/self/stat") as stat:
        started = int(stat.read().rpartition(")")[2].split()[19]) / os.sysconf("SC_CLK_TCK")
    return (name, time.clock_gettime(time.CLOCK_BOOTTIME) - started, _processor_seconds())


class Stopwatch:
    """Measures the real time and the processor time of consecutive phases, summed over all processes in /proc."""

    def __init__(self) -> None:
        self._wall, self._cpu = real_monotonic_ns(), _processor_seconds()

    def lap(self, name: str) -> Phase:
        """End a phase and begin the next."""
        wall, cpu = real_monotonic_ns(), _processor_seconds()
        phase = (name, (wall - self._wall) * 1e-9, max(0.0, cpu - self._cpu))
        self._wall, self._cpu = wall, cpu
        return phase


class Phases:
    """Records the phases of one scenario; does nothing unless they are wanted."""

    def __init__(self, log: ArenaLog, wanted: bool, earlier: Sequence[Phase] = ()) -> None:
        self._log = log
        self._stopwatch = Stopwatch() if wanted else None
        if wanted:
            for phase in earlier:
                self._record(phase)

    def end(self, name: str) -> None:
        """End a phase."""
        if self._stopwatch:
            self._record(self._stopwatch.lap(name))

    def _record(self, phase: Phase) -> None:
        from autograder.arena.events import PhaseEnded

        name, wall, cpu = phase
        self._log.append(PhaseEnded(name=name, wall=wall, cpu=cpu))


def _processor_seconds() -> float:
    """Return the processor time of all processes that live now, with all their threads."""
    total = 0.0
    for name in os.listdir("/proc"):
        if name.isdigit():
            with suppress(OSError):
                total += time.clock_gettime((~int(name) << 3) | _CPU_CLOCK)
    return total
