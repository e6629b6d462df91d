"""The student's program in an arena: started once, monitored, and ended with the scenario."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Sequence

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.scenario_spec import ScenarioSpec
from autograder.arena.student_limits_monitor import StudentLimitsMonitor
from autograder.isolation.student_process import StudentProcess
from autograder.isolation.student_sandbox import Program
from ros_runtime.environment import ros_environment
from ros_runtime.workarounds.rclpy_repairs.hook import STACK_FILE
from ros_runtime.workarounds.scaled_clock.clock import ScaledClock

ABORT_TIMEOUT = 0.5  # s of real time for faulthandler to print the stacks, and for the program's end
PRINT_TIMEOUT = 0.2  # s of real time for faulthandler to print the stacks
STDERR = "2"  # its descriptor
LONGEST_STACK, LONGEST_LINE = 200, 200  # lines, characters


class Student:
    """Runs the files of a submission in the student's sandbox and records output and exit."""

    def __init__(self, spec: ScenarioSpec, log: ArenaLog, clock: ScaledClock) -> None:
        self._spec = spec
        self._log = log
        self._clock = clock
        self._process: StudentProcess | None = None
        self._watch: StudentLimitsMonitor | None = None
        self._closing = threading.Event()
        self._stack: list[str] | None = None  # lines of stderr while it prints its stacks

    def start(self, arguments: Sequence[str] = ()) -> None:
        """Run the student's program as a ROS node in the robot's namespace."""
        ros_arguments = ["--ros-args", "-r", f"__ns:={self._spec.namespace}"]
        for name, value in self._spec.parameters.items():
            ros_arguments += ["-p", f"{name}:={json.dumps(value)}"]
        arguments = [self._spec.program, *arguments, *ros_arguments]
        self._start(arguments, list(self._spec.files))

    def start_module(self, module: str, arguments: Sequence[str], files: Sequence[str]) -> None:
        """Run a module of the grader on some of the student's files, with the rights of the student's program."""
        self._start(["-m", module, *arguments], files, builds=True)

    def has_exited(self) -> bool:
        """Return whether the program has ended, with its exit and all its output in the log."""
        return self._log.count(ev.NodeExited) > 0

    def stacks(self) -> ev.NodeStack | None:
        """Return the stacks of the running program, which goes on; None if it has ended or its stacks are recorded."""
        if self._process is None or self.has_exited() or self._log.count(ev.NodeStack):
            return None
        stacks = self._stacks(self._process, self._process.print_stacks, PRINT_TIMEOUT)
        self._stack = None  # what it prints from now on is its output again
        return stacks

    def interrupt(self) -> None:
        """Send SIGINT, as Ctrl-C does."""
        self._running.interrupt()

    def type_line(self, text: str) -> None:
        """Type a line on its stdin; nothing happens when it has ended."""
        self._running.write_line(text)

    def end_input(self) -> None:
        """End its stdin."""
        self._running.close_stdin()

    def wait(self, timeout: float) -> int | None:
        """Wait for the end and return the exit status, or None after `timeout` s."""
        return self._running.wait(timeout)

    def count_from_now(self) -> None:
        """Measure processor time used and missed from now on, at the clock's final scale, or from a later start on."""
        if self._watch:
            self._watch.count_from_now()

    def record_waiting(self) -> None:
        """Record how long the program waited for a processor so far, if it was started."""
        if self._watch:
            self._watch.record_waiting()

    def close(self) -> None:
        """Record the resources used, and end the program."""
        self._closing.set()
        if self._process and self._watch:
            self._watch.report()
            silent = self._log.count(ev.Unanswered) or self._log.count(ev.NodeSignalled)
            if silent and not self.has_exited() and not self._log.count(ev.NodeStack):
                # this ends the program
                self._log.append(self._stacks(self._process, self._process.abort, ABORT_TIMEOUT))
            self._process.kill()

    @property
    def _running(self) -> StudentProcess:
        if self._process is None:
            raise RuntimeError("the scenario has not started the student's program yet")
        return self._process

    def _start(self, arguments: Sequence[str], names: Sequence[str], builds: bool = False) -> None:
        files = {name: content for name, content in self._spec.files.items() if name in names}
        self._log.append(ev.NodeStarted())
        program = Program(
            arguments,
            files,
            env={
                **ros_environment(),
                **self._clock.environment(),
                "PYTHONFAULTHANDLER": "1",
                STACK_FILE: STDERR,
            },
            read_only_paths=[*self._spec.student_paths, self._clock.path],
            builds=builds,
        )
        self._process = StudentProcess(program, self._on_line, self._on_exit)
        self._watch = StudentLimitsMonitor(
            self._process, self._log, self._clock, program.limits, self._spec.private_network
        )

    def _stacks(
        self, process: StudentProcess, print_them: Callable[[], None], timeout: float
    ) -> ev.NodeStack:
        """Return what a program prints within `timeout` (s of real time) after it was told to print its stacks."""
        self._stack = []
        print_them()
        process.wait(timeout * self._clock.scale)
        return ev.NodeStack(lines=self._stack[:LONGEST_STACK])

    def _on_line(self, t: float, stream: str, text: str) -> None:
        if self._stack is not None and stream == "stderr":
            self._stack.append(text[:LONGEST_LINE])
            return
        self._log.append(ev.NodeOutput(t=t, stream="stderr" if stream == "stderr" else "stdout", text=text))

    def _on_exit(self, returncode: int) -> None:
        if not self._closing.is_set():  # while closing, the grader has ended the program
            self._log.append(ev.NodeExited(returncode=returncode))
