"""The controller's side of an arena: start it, watch memory and deadline, make sure that every process has ended.

    spec = ArenaSpec([sys.executable, "-m", "autograder.arena.host"], read_only_paths=[…], pass_fds=[orders])
    arena = ArenaProcess(spec, available_isolation().kind)
    report = arena.wait()

The command is trusted; what it starts with `student_process` is not.
"""

from __future__ import annotations

import signal
import threading
import time
from concurrent.futures import Future
from contextlib import ExitStack
from dataclasses import dataclass
from enum import Enum

from autograder.isolation.arena_spec import ArenaSpec, Kind
from autograder.isolation.arena_start import RunningArena, start_with_namespaces, start_without_namespaces
from autograder.isolation.bubblewrap import SandboxError
from autograder.isolation.captured_output import CapturedOutput, OutputPump
from autograder.isolation.limits import ArenaLimits
from autograder.isolation.process_tree import cpu_seconds, descendants, resident_mib

__all__ = ["ArenaProcess", "ArenaReport", "ArenaSpec", "Ended", "Kind"]

_POLL = 0.05  # s between two checks of the deadline and of `kill`
_MEMORY_PERIOD = 0.2  # s between two measurements of memory, each of which reads a dozen files per process
_LAST_WORDS = 2.0  # s to read the remaining output of an ended arena, if a process still holds it open
_AFTER_SIGKILL = ", most often because the machine's memory ran out: grade again with --jobs 1"


class Ended(str, Enum):
    """How an arena came to its end."""

    EXIT = "exit"  # the command ended by itself
    DEADLINE = "deadline"
    MEMORY = "memory"
    KILLED = "killed"  # by `kill`


@dataclass(frozen=True)
class ArenaReport:
    """How an arena ended.

    `nothing_survives`: every process of the arena is gone, as confirmed by the kernel (with namespaces) or by the
    reaper (without).
    """

    ended: Ended
    exit_code: int  # the command's; 128 + n when signal n ended it
    seconds: float  # wall time from start to end
    peak_memory_mib: float  # resident, all processes together, seen by polling
    processor_seconds: float  # sampled: misses the last part of killed processes
    nothing_survives: bool
    stdout: CapturedOutput
    stderr: CapturedOutput

    def explain(self, limits: ArenaLimits) -> str:
        """Return a sentence for a log."""
        if self.ended is Ended.DEADLINE:
            return f"the arena was ended at its deadline of {limits.deadline_s:g} s"
        if self.ended is Ended.MEMORY:
            return (
                f"the arena used {self.peak_memory_mib:.0f} MiB of memory; it may use {limits.memory_mib} MiB"
            )
        if self.ended is Ended.KILLED:
            return "the arena was ended on request"
        number = self.exit_code - 128
        if number in set(signal.Signals):
            advice = _AFTER_SIGKILL if number == signal.SIGKILL else ""
            return (
                f"the arena's command was killed by signal {number} ({signal.Signals(number).name}){advice}"
            )
        return f"the arena's command ended with status {self.exit_code}"


class ArenaProcess:
    """A started arena, whose command is about to run. A thread of its own starts, watches and ends it.

    Raises:
        SandboxError: it cannot start.
    """

    def __init__(self, spec: ArenaSpec, kind: Kind) -> None:
        self.spec = spec
        self.kind = kind
        self._kill_requested = threading.Event()
        self._deadline = time.monotonic() + spec.limits.deadline_s
        self._started: Future[None] = Future()
        self._report: Future[ArenaReport] = Future()
        threading.Thread(target=self._live, name="arena", daemon=True).start()
        self._started.result()

    def poll(self) -> ArenaReport | None:
        """Return the report when the arena has ended, else None."""
        return self._report.result() if self._report.done() else None

    def wait(self, timeout: float | None = None) -> ArenaReport:
        """Wait for the end, at the latest at the arena's deadline. Raises TimeoutError after `timeout` s."""
        return self._report.result(timeout)

    def kill(self) -> ArenaReport:
        """End every process of the arena and return the report."""
        self._kill_requested.set()
        return self.wait()

    def allow(self, seconds: float) -> None:
        """Set the deadline to this number of seconds from now."""
        self._deadline = time.monotonic() + seconds

    def _live(self) -> None:
        try:
            report = self._run()
        except BaseException as error:
            waiting = self._report if self._started.done() else self._started
            waiting.set_exception(error)
        else:
            self._report.set_result(report)

    def _run(self) -> ArenaReport:
        began = time.monotonic()
        with ExitStack() as stack:
            try:
                if self.kind is Kind.NAMESPACES:
                    running = start_with_namespaces(self.spec, stack)
                else:
                    running = start_without_namespaces(self.spec, stack, self.kind)
            except OSError as error:  # no descriptors, processes or disk left
                raise SandboxError(f"an arena could not be started: {error}") from error
            self._started.set_result(None)
            try:
                return self._watch(running, began)
            except BaseException:
                running.end()
                raise

    def _watch(self, running: RunningArena, began: float) -> ArenaReport:
        limits, process, group = self.spec.limits, running.process, running.memory_group
        out, err = CapturedOutput(limits.output_kib), CapturedOutput(limits.output_kib)
        assert process.stdout
        assert process.stderr
        pump = OutputPump({process.stdout.fileno(): out, process.stderr.fileno(): err})
        pump.watch(running.end_pidfd)
        ended, peak, used = Ended.EXIT, 0.0, 0.0
        next_look = next_look_at_memory = began
        memory_within_limit_at = began
        while running.end_pidfd not in pump.poll(max(0.0, min(_POLL, next_look - time.monotonic()))):
            if (now := time.monotonic()) < next_look:
                continue
            next_look = now + _POLL
            if now >= next_look_at_memory:
                next_look_at_memory = now + _MEMORY_PERIOD
                processes = [running.root_pid, *descendants(running.root_pid)]
                memory, used = resident_mib(processes), max(used, cpu_seconds(processes))
                peak = max(peak, memory)
                if memory <= limits.memory_mib:
                    memory_within_limit_at = now
                borne_for = now - memory_within_limit_at
                if memory > 2 * limits.memory_mib or borne_for > limits.memory_grace_s:
                    ended = Ended.MEMORY
                if group and group.was_exceeded():
                    ended = Ended.MEMORY
            if ended is Ended.EXIT and now > self._deadline:
                ended = Ended.DEADLINE
            if ended is Ended.EXIT and self._kill_requested.is_set():
                ended = Ended.KILLED
            if ended is not Ended.EXIT:
                used = max(used, cpu_seconds([running.root_pid, *descendants(running.root_pid)]))
                break
        nothing_survives = running.end() if ended is not Ended.EXIT else running.has_ended()
        exit_code = process.wait()
        if group and group.was_exceeded():  # the kernel may have killed the arena's last process
            ended, peak = Ended.MEMORY, max(peak, float(limits.most_memory_mib))
        pump.finish(_LAST_WORDS)
        process.stdout.close()
        process.stderr.close()
        seconds = time.monotonic() - began
        return ArenaReport(
            ended,
            exit_code if exit_code >= 0 else 128 - exit_code,
            seconds,
            peak,
            used,
            nothing_survives,
            out,
            err,
        )
