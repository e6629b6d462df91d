"""Enforces the memory limit of a student's processes and adds up their processor time."""

from __future__ import annotations

import threading
import time

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.isolation.limits import StudentLimits
from autograder.isolation.process_tree import cpu_seconds, resident_mib, seconds_without_a_processor
from autograder.isolation.student_process import StudentProcess
from ros_runtime.workarounds.scaled_clock.clock import ScaledClock, real_monotonic_ns

PERIOD = 0.1  # s of real time between two measurements, which read some files of every process


class StudentLimitsMonitor:
    """A thread that ends the student's processes above the limit, before a memory bomb ends the arena."""

    def __init__(
        self, student: StudentProcess, log: ArenaLog, clock: ScaledClock, limits: StudentLimits
    ) -> None:
        self._student = student
        self._clock = clock
        self._log = log
        self._limits = limits
        self._started = real_monotonic_ns()
        self._cpu = 0.0
        self._peak = 0.0
        self._starved: dict[int, float] = {}
        threading.Thread(target=self._watch, name="student limits", daemon=True).start()

    def report(self) -> None:
        """Record the resources used so far."""
        self._look()
        wall = (real_monotonic_ns() - self._started) / 1e9
        self._log.append(ev.NodeUsage(cpu=self._cpu, wall=wall, peak_memory_mib=self._peak))

    def starved(self) -> float:
        """Return how long (s of real time) the processes have waited for a processor so far."""
        return sum(self._starved.values())

    def _watch(self) -> None:
        while self._student.returncode is None:
            used = self._look()
            if used > self._limits.memory_mib:
                reason = f"it used {used:.0f} MiB of memory; {self._limits.memory_mib} MiB are allowed"
                self._log.append(ev.NodeKilled(reason=reason))
                self._student.kill()
                return
            time.sleep(PERIOD * self._clock.scale)  # this process follows the clock

    def _look(self) -> float:
        """Return the memory in use (MiB)."""
        processes = self._student.processes()
        self._cpu = max(self._cpu, cpu_seconds(processes))
        used = resident_mib(processes)
        self._peak = max(self._peak, used)
        for process in processes:
            self._starved[process] = max(
                self._starved.get(process, 0.0), seconds_without_a_processor(process)
            )
        return used
