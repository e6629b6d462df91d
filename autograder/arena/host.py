"""The first process of an arena: it imports everything, builds the robot once, and forks an agent for each scenario.

It runs as `python -m autograder.arena.host SOCKET`.

An order consists of the specification of a scenario and the pipe for its events. The host answers it when all processes
of the scenario have ended. The library of the scaled clock is preloaded into this process, but only its forks use such
a clock, each that of its scenario.
"""

from __future__ import annotations

from autograder.arena.phases import Stopwatch, since_start

INTERPRETER, STOPWATCH = since_start("interpreter"), Stopwatch()  # before anything costs time

# ruff: noqa: E402
import ctypes
import gc
import multiprocessing
import os
import signal
import socket
import sys
import time
from contextlib import suppress
from itertools import count

import rosidl_generator_py  # noqa: F401  (the first message of a fork would load it, in 20 ms)

from autograder.arena.agent import carry_out, scenarios_in
from autograder.arena.phases import Phase
from autograder.arena.robots import Robots
from autograder.arena.scenario_spec import DONE, ScenarioSpec, receive_order
from autograder.isolation.process_tree import descendants

_PR_SET_CHILD_SUBREAPER = 36
_FIRST_DOMAIN, _DOMAINS = 1, 100  # ROS domains whose ports are safe; the network is this arena's own


class Host:
    """What the scenarios of one submission share: imported modules and built robots."""

    def __init__(self) -> None:
        self._robots = Robots()
        self._numbers = count()
        self._stopwatch = STOPWATCH
        # orphans of a scenario become our children, and we end them
        ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)

    def carry_out(self, spec: ScenarioSpec, events_fd: int) -> None:
        """Carry out one scenario in processes and on a ROS domain of its own; return when they have ended."""
        number = next(self._numbers)
        phases = self._prepare(spec)
        domain = _FIRST_DOMAIN + number % _DOMAINS if spec.private_network else None
        gc.freeze()  # a collection in a fork would copy the pages that it shares with this process
        agent = multiprocessing.get_context("fork").Process(
            target=carry_out,
            args=(spec, events_fd, self._robots, domain, phases if number == 0 else ()),
        )
        agent.start()
        os.close(events_fd)
        agent.join()
        self._end_remaining_processes()

    def _prepare(self, spec: ScenarioSpec) -> list[Phase]:
        """Import and build what the scenario needs, unless that was done before; return the phases with their costs."""
        scenarios_in(spec.scenario_file)
        phases = [INTERPRETER, self._stopwatch.lap("imports")]
        if spec.robot_options is not None:
            self._robots.build(spec.robot_options)
            phases.append(self._stopwatch.lap("model"))
        return phases

    def _end_remaining_processes(self) -> None:
        while left := descendants(os.getpid()):
            for pid in left:
                with suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            for pid in left:
                with suppress(ChildProcessError):
                    os.waitpid(pid, os.WNOHANG)
            time.sleep(0.001)


def main() -> None:
    """Serve orders until the controller closes the socket."""
    # students' nodes inherit both: a script's background process would ignore SIGINT, and where SIGCHLD is ignored the
    # kernel does not count the time of their children
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    orders = socket.socket(fileno=int(sys.argv[1]))
    host = Host()
    while order := receive_order(orders):
        host.carry_out(*order)
        orders.sendall(DONE)


if __name__ == "__main__":
    main()
