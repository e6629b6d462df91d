"""Enforces limits on a student's processes that the kernel does not offer, and measures their processor time."""

from __future__ import annotations

import threading
import time
from collections import deque

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.isolation.limits import StudentLimits
from autograder.isolation.open_sockets import too_many_sockets
from autograder.isolation.process_tree import cpu_seconds, resident_mib, seconds_without_a_processor
from autograder.isolation.student_process import StudentProcess
from ros_runtime.workarounds.scaled_clock.clock import ScaledClock, real_monotonic_ns

PERIOD = 0.1  # s of real time between two measurements, which read some files of every process
BURST_TIME = 0.5  # s of real time, over which the number of busy processors is averaged
WAIT_TIME = 1.0  # s on the arena's clock, over which the missed processor time is averaged


class StudentLimitsMonitor:
    """A thread that ends the student's processes above a limit, before they end the arena or hurt the machine.

    The processor time is exact: the kernel adds a child's time to the process that waits for it, the sandbox's init
    waits for all orphans, and the filter forbids children that nobody waits for (`isolation/seccomp_filter.py`).
    """

    def __init__(
        self,
        student: StudentProcess,
        log: ArenaLog,
        clock: ScaledClock,
        limits: StudentLimits,
        private_network: bool,
    ) -> None:
        self._student = student
        self._clock = clock
        self._log = log
        self._limits = limits
        self._private_network = private_network
        self._started = real_monotonic_ns()
        self._cpu = 0.0
        self._peak = 0.0
        self._starved: dict[int, float] = {}
        self._lost = MissedTime()
        self._cpu_before = 0.0
        self._in_time_since = time.monotonic()
        self._busy, self._losing = FastestGrowth(), FastestGrowth()
        self._looking = threading.Lock()
        threading.Thread(target=self._watch, name="student limits", daemon=True).start()

    def count_from_now(self) -> None:
        """Restart the measurements, because the arena's clock has reached its scale."""
        self._look()
        with self._looking:
            self._cpu_before, self._in_time_since = self._cpu, time.monotonic()
            self._busy, self._losing = FastestGrowth(), FastestGrowth()
            self._look_at_growth()

    def report(self) -> None:
        """Record the resources used so far."""
        self._look()
        usage = ev.NodeUsage(
            cpu=self._cpu,
            wall=(real_monotonic_ns() - self._started) / 1e9,
            peak_memory_mib=self._peak,
            cpu_in_time=self._cpu - self._cpu_before,
            in_time=time.monotonic() - self._in_time_since,
            burst=self._busy.rate,
        )
        self._log.append(usage)

    def record_waiting(self) -> None:
        """Record how much processor time the processes have missed so far because of other programs."""
        self._look()
        self._log.append(ev.Starved(seconds=self._losing.rate, altogether=self._lost.total))

    def _watch(self) -> None:
        while self._student.returncode is None:
            excess = self._look()
            if excess:
                self._log.append(ev.NodeKilled(reason=excess))
                self._student.kill()
                return
            time.sleep(PERIOD * self._clock.scale)  # sleep() follows the scaled clock; PERIOD is real time

    def _look(self) -> str:
        """Measure; return the reason to end the program if it exceeds a limit, else ""."""
        with self._looking:
            processes = self._student.processes()
            self._cpu = max(self._cpu, cpu_seconds(processes))
            used = resident_mib(processes)
            self._peak = max(self._peak, used)
            for process in processes:
                self._starved[process] = max(
                    self._starved.get(process, 0.0), seconds_without_a_processor(process)
                )
            self._look_at_growth()
        return self._excess(processes, used)

    def _look_at_growth(self) -> None:
        now = real_monotonic_ns() / 1e9
        self._lost.look(now, self._cpu, sum(self._starved.values()))
        self._busy.look(now, self._cpu, BURST_TIME)
        self._losing.look(now, self._lost.total, WAIT_TIME / self._clock.scale)

    def _excess(self, processes: list[int], memory: float) -> str:
        limits = self._limits
        if memory > limits.memory_mib:
            return f"it used {memory:.0f} MiB of memory; {limits.memory_mib} MiB are allowed"
        if (files := self._student.files()) > limits.files:
            return f"it made {files:,} files; {limits.files:,} are allowed"
        return too_many_sockets(processes, limits, self._private_network)


class MissedTime:
    """Sums the processor time that a program missed, up to one full processor, while its processes had to wait.

    A program whose processes together get the time of one processor misses nothing: a correct program needs no more,
    and its processes then wait for each other.
    """

    def __init__(self) -> None:
        self.total = 0.0  # s
        self._last: tuple[float, float, float] | None = None

    def look(self, now: float, used: float, waited: float) -> None:
        """Add a sample at time `now` (s): the totals (s) of used and of awaited processor time over all processes."""
        then, used_then, waited_then = self._last or (now, used, waited)
        lacking = (now - then) - (used - used_then)
        self.total += max(0.0, min(waited - waited_then, lacking))
        self._last = now, used, waited


class FastestGrowth:
    """The highest growth rate (1/s) of a total, averaged over intervals of at least a given length."""

    def __init__(self) -> None:
        self._looks: deque[tuple[float, float]] = deque()  # s, total
        self.rate = 0.0

    def look(self, now: float, total: float, stretch: float) -> None:
        """Add a sample of the total at time `now` (s); intervals shorter than `stretch` (s) count as `stretch`."""
        self._looks.append((now, total))
        while len(self._looks) > 1 and now - self._looks[1][0] >= stretch:
            self._looks.popleft()
        then, before = self._looks[0]
        self.rate = max(self.rate, (total - before) / max(stretch, now - then))
