"""Runs a student's client: a program that ends by itself, with an exit status."""

from __future__ import annotations

import time
from pathlib import Path

from autograder.authoring.diagnosis.exit_diagnosis import remedy_for_a_traceback
from lab.client.connection import connection
from lab.running.node_diagnosis import what_is_missing, with_code_of
from lab.running.processes import Process, ProcessHistory
from lab.running.student_nodes import existing_file, in_namespace

_running: dict[Path, Program] = {}


def run_program(file: str | Path, *arguments: str, timeout: float = 30.0) -> Program:
    """Run a Python file in namespace /robot and wait for its end, like `start_program` and then `wait`.

    Raises LabError when there is no such file.
    """
    return start_program(file, *arguments).wait(timeout)


def start_program(file: str | Path, *arguments: str) -> Program:
    """Start a Python file as a process in namespace /robot, and do not wait for its end.

    If a program that was started earlier from the same file still runs, it is stopped first.

    Raises LabError when there is no such file.
    """
    path = existing_file(file)
    if path in _running:
        _running.pop(path).stop()
    connection()  # sets the environment that the child inherits
    program = Program(path, Process([str(path), *in_namespace(arguments)], own_stderr=True))
    _running[path] = program
    return program


def stop_programs() -> None:
    """Stop every program that still runs."""
    for program in _running.values():
        program.stop()
    _running.clear()


class Program:
    """A file that runs, or has run, as a process.

    Attributes:
        file: its path.
        stopped: whether it was stopped because it did not end by itself.
    """

    def __init__(self, file: Path, process: Process) -> None:
        self.file = file
        self.stopped = False
        self._process = process
        self._started = time.monotonic()
        self._seconds: float | None = None

    @property
    def exit_status(self) -> int | None:
        """The exit status; None while the program runs, and if it was stopped."""
        return None if self.stopped else self._process.exit_status

    @property
    def stdout(self) -> str:
        """What the program has written to stdout: the output of `print()`."""
        return self._process.output()

    @property
    def stderr(self) -> str:
        """What the program has written to stderr: log messages and tracebacks."""
        return self._process.errors()

    @property
    def seconds(self) -> float:
        """How long the program ran until `wait` returned, in s; before that, how long it has run so far."""
        return time.monotonic() - self._started if self._seconds is None else self._seconds

    def wait(self, timeout: float = 30.0) -> Program:
        """Wait for the program's end, or stop it after `timeout` s; return the program itself."""
        ended = self._process.wait(timeout)
        self._seconds = self._seconds or self.seconds
        if not ended:
            self.stop()
        return self

    def history(self) -> ProcessHistory:
        """Return when the program began and ended, and its printed lines with their times, for a picture."""
        return ProcessHistory.of(self.file.name, self._process, was_stopped=self.stopped)

    def stop(self) -> None:
        """Send SIGINT, as Ctrl-C does, and SIGKILL if the program does not end within 3 s."""
        if self._process.is_running:
            self.stopped = True
            self._process.stop()

    def __repr__(self) -> str:
        return f"<{self.file.name}: {self._state()}>"

    def __str__(self) -> str:
        lines = (self.stdout + self.stderr).replace(f"{self.file.resolve().parent}/", "").splitlines()
        remedy = remedy_for_a_traceback(self.stderr) if self.exit_status else None
        help = f"\n{with_code_of(self.file, remedy.help)}" if remedy else ""
        if not lines and (missing := what_is_missing([self.file])):
            help = f"\nIt printed nothing.{missing}"
        return "\n    ".join([repr(self), *lines]) + help

    def _state(self) -> str:
        if self.stopped:
            return f"had not ended after {self.seconds:.1f} s and was stopped"
        if self._process.is_running:
            return f"running for {self.seconds:.1f} s"
        return f"exit status {self.exit_status} after {self.seconds:.1f} s"
