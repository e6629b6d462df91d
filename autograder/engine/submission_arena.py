"""The controller's handle of an arena: it sends scenarios one after another and receives their events.

An arena serves one submission, so that no submission can see another. Within an arena each scenario has processes, a
ROS domain and a working folder of its own, and begins after all processes of the previous one have ended.
"""

from __future__ import annotations

import os
import select
import socket
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from autograder.arena.scenario_spec import DONE, ScenarioSpec, send_order
from autograder.engine.stop import Stop
from autograder.isolation.arena_process import ArenaProcess, ArenaReport, ArenaSpec, Kind
from autograder.isolation.limits import ArenaLimits
from autograder.isolation.python_paths import python_read_only_paths
from ros_runtime.environment import ros_environment
from ros_runtime.project import PROJECT
from ros_runtime.ros_domain import loopback_variables
from ros_runtime.workarounds.scaled_clock.clock import preload_variables

REPORT_LIMIT = 64 * 2**20  # bytes of events of one scenario
LIMITS = ArenaLimits(deadline_s=120.0)  # deadline for the arena's start; each scenario sets its own
IDLE_TIMEOUT = 3600.0  # s for which an arena may wait for its next scenario
_POLL_PERIOD = 0.1  # s between two checks of `stop`
_END_TIMEOUT = 15.0  # s for the processes of a scenario to end


class ArenaEnded(Exception):
    """The arena ended before the scenario did; `events` are the lines received until then."""

    def __init__(self, report: ArenaReport, events: bytes = b"") -> None:
        super().__init__(f"{report.explain(LIMITS)}\n{report.stderr.text[-2000:]}")
        self.report = report
        self.events = events


class SubmissionArena:
    """A started arena for the scenarios of one file.

    Raises:
        SandboxError: it cannot start.
    """

    def __init__(self, scenario_file: Path, kind: Kind) -> None:
        self._orders, theirs = socket.socketpair()
        environment = {
            **ros_environment(),
            **preload_variables(),
            **loopback_variables(),
            "PYTHONPATH": str(PROJECT),
            "PYTHONDONTWRITEBYTECODE": "1",
            "MUJOCO_GL": "disable",  # nothing is drawn here, and looking for a screen takes 0.13 s
        }
        with theirs:
            spec = ArenaSpec(
                [sys.executable, "-m", "autograder.arena.host", str(theirs.fileno())],
                read_only_paths=[*ros_paths(), *_trusted_paths(), scenario_file],
                pass_fds=[theirs.fileno()],
                env=environment,
                limits=LIMITS,
            )
            try:
                self._process = ArenaProcess(spec, kind)
            except BaseException:
                self._orders.close()
                raise
        self.kind = self._process.kind
        self.scenarios = 0  # so far

    def carry_out(self, spec: ScenarioSpec, deadline: float, stop: Stop | None) -> bytes:
        """Carry out a scenario and return its events, one JSON object a line.

        Args:
            spec: the scenario.
            deadline: s of real time after which the arena is ended.
            stop: when it is set, the arena is ended.

        Raises:
            ArenaEnded: the arena ended before the scenario: at the deadline, because of `stop`, because it sent more
                events than fit into a report, or by itself.
        """
        self.scenarios += 1
        self._process.allow(deadline)
        read_end, write_end = os.pipe()
        with os.fdopen(read_end, "rb", buffering=0) as events:
            try:
                send_order(self._orders, spec, write_end)
            except OSError:
                raise ArenaEnded(self._process.wait()) from None
            finally:
                os.close(write_end)
            report = self._read(events.fileno(), stop)
        self._await_the_end_of_its_processes(report, stop)
        self._process.allow(IDLE_TIMEOUT)
        return report

    def close(self) -> ArenaReport:
        """End the arena with everything in it, if it has not ended, and return how it ended."""
        self._orders.close()
        return self._process.kill()

    def _read(self, fd: int, stop: Stop | None) -> bytes:
        """Read events until the scenario is over."""
        report = bytearray()
        while len(report) < REPORT_LIMIT:
            if stop and stop.is_set():
                raise ArenaEnded(self._process.kill())
            if self._process.poll() and not _is_readable(fd, 0):
                raise ArenaEnded(self._process.wait(), bytes(report))
            if not _is_readable(fd, _POLL_PERIOD):
                continue
            chunk = os.read(fd, 2**20)
            if not chunk:
                return bytes(report)
            report += chunk
        raise ArenaEnded(self._process.kill())

    def _await_the_end_of_its_processes(self, report: bytes, stop: Stop | None) -> None:
        deadline = time.monotonic() + _END_TIMEOUT
        while time.monotonic() < deadline and not (stop and stop.is_set()):
            if self._process.poll():
                raise ArenaEnded(self._process.wait(), report)
            if _is_readable(self._orders.fileno(), _POLL_PERIOD):
                with suppress(OSError):
                    if self._orders.recv(len(DONE)) == DONE:
                        return
                break
        raise ArenaEnded(self._process.kill(), report)


def ros_paths() -> list[Path]:
    """Return the paths that any ROS process reads: Python with its packages, and a sourced ROS 2 if there is one."""
    sourced = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return [
        *python_read_only_paths(),
        *(Path(prefix) for prefix in sourced if prefix.startswith("/opt/ros/")),
    ]


def student_paths() -> Sequence[Path]:
    """Return the paths of this machine that a student's program may read, besides the system's."""
    return (*ros_paths(), PROJECT / "ros_runtime")


def _trusted_paths() -> list[Path]:
    """Return the project's folders that every arena may read: no checks, no solutions, no other submissions."""
    grader = PROJECT / "autograder"
    return [
        PROJECT / "ros_runtime",
        PROJECT / "robot_sim",
        grader / "__init__.py",
        grader / "arena",
        grader / "isolation",
    ]


def _is_readable(fd: int, timeout: float) -> bool:
    poll = select.poll()
    poll.register(fd, select.POLLIN)
    return bool(poll.poll(timeout * 1000))
