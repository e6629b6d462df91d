"""The arena's side: runs a student's program in a sandbox of its own inside the arena.

    student = StudentProcess(Program(["walk.py"], {"walk.py": code}))
    student.interrupt()
    student.wait(5.0)

The program shares the arena's private network and nothing else: it has its own users, processes, IPC, mounts
and environment. All durations are on this process's clock. In an arena without namespaces it works in the same way,
but without the sandbox.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import ExitStack, suppress

from autograder.isolation.captured_output import CapturedOutput, OutputPump
from autograder.isolation.running_program import RunningProgram
from autograder.isolation.student_sandbox import Program, start_program
from ros_runtime.workarounds.rclpy_repairs.hook import STACK_SIGNAL

_POLL = 0.2  # s between two checks while nothing is printed
_LAST_WORDS = 2.0  # s for output that is still in the pipes of an ended program


class StudentProcess:
    """A student's running program. `stdout` and `stderr` hold what it printed so far, within the limit.

    `on_line(time, "stdout" | "stderr", text)` is called for each kept line, `on_exit(returncode)` once after the last
    line, both on a background thread.

    Raises:
        SandboxError: the sandbox cannot be started.
    """

    def __init__(
        self,
        program: Program,
        on_line: Callable[[float, str, str], object] | None = None,
        on_exit: Callable[[int], object] | None = None,
    ) -> None:
        limit = program.limits.output_kib
        self.stdout = CapturedOutput(
            limit, on_line and (lambda line: on_line(line.time, "stdout", line.text))
        )
        self.stderr = CapturedOutput(
            limit, on_line and (lambda line: on_line(line.time, "stderr", line.text))
        )
        self._program = program
        self._on_exit = on_exit
        self._returncode: int | None = None
        self._ended = threading.Event()
        self._started: Future[RunningProgram] = Future()
        threading.Thread(target=self._live, name="student", daemon=True).start()
        self._running = self._started.result()

    @property
    def returncode(self) -> int | None:
        """The program's exit status, -n when signal n ended it; None while it runs.

        bwrap reports signal n as status 128 + n, so in a sandbox an exit status of 129 to 192 counts as a signal.
        """
        return self._returncode

    def wait(self, timeout: float | None = None) -> int | None:
        """Wait for the end and the last output; returns the return code, or None after `timeout` s."""
        self._ended.wait(timeout)
        return self._returncode

    def write_line(self, text: str) -> None:
        """Type a line on the program's stdin; nothing happens when it no longer reads."""
        with suppress(OSError, ValueError):  # it has ended, or its input has
            self._running.stdin.write(text.encode() + b"\n")

    def close_stdin(self) -> None:
        """End the program's input, as Ctrl-D does."""
        self._running.stdin.close()

    def processes(self) -> list[int]:
        """Return the ids, in the arena, of the program and everything it started; [] once it has ended."""
        if self._returncode is not None:
            return []
        return self._running.processes()

    def files(self) -> int:
        """Return the number of files in the program's private folders; 0 if it has none or has ended."""
        return 0 if self._returncode is not None else self._running.files()

    def interrupt(self) -> None:
        """Send SIGINT to the program and to the processes that it started, as Ctrl-C in a terminal does."""
        self._running.interrupt()

    def abort(self) -> None:
        """Send SIGABRT to the program itself: it ends; with PYTHONFAULTHANDLER it first prints its threads' stacks."""
        self._running.signal(signal.SIGABRT)

    def print_stacks(self) -> None:
        """Have a Python program with the variable STACK_FILE print its threads' stacks; it goes on."""
        self._running.signal(signal.Signals(STACK_SIGNAL))

    def terminate(self) -> None:
        """Send SIGTERM to the program itself."""
        self._running.signal(signal.SIGTERM)

    def kill(self) -> None:
        """End the program and everything it started, and wait until it is gone."""
        self._running.end()
        self._ended.wait()

    def _live(self) -> None:
        with ExitStack() as stack:
            try:
                running = start_program(self._program, stack)
            except BaseException as error:
                self._started.set_exception(error)
                return
            self._started.set_result(running)
            try:
                self._follow(running)
            finally:
                self._returncode = running.close()
                try:
                    if self._on_exit:
                        self._on_exit(self._returncode)
                finally:
                    self._ended.set()

    def _follow(self, running: RunningProgram) -> None:
        pump = OutputPump({running.stdout.fileno(): self.stdout, running.stderr.fileno(): self.stderr})
        pump.watch(running.end_fd)
        while running.end_fd not in pump.poll(_POLL):
            pass
        running.end()
        pump.finish(_LAST_WORDS)
        self.close_stdin()
        running.stdout.close()
        running.stderr.close()
