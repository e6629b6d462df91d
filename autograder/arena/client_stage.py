"""What a scenario for a client can do: offer scripted services and run the student's program to its end.

Nothing is judged here, and all durations are seconds on the arena's clock, as in `stage.py`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from itertools import count
from typing import Any

from rclpy.node import Node

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.graph import Graph
from autograder.arena.phases import Phases
from autograder.arena.scripted_service import Reply, ScriptedService
from autograder.arena.student import Student
from autograder.arena.waiting import Waiting

# s, on a clock that still runs at scale 1:
APPEARING_TIMEOUT = 20.0  # for the student's node to appear
MODULE_TIMEOUT = 150.0  # for work of ours in the student's sandbox, such as compiling
MATCHING_TIMEOUT = 3.0  # for its clients to be seen; some programs make them only when they need them
SETTLING = 0.05  # for the program's own side of those connections
# s, on the arena's clock:
END_TIMEOUT = 25.0


class ClientStage(Waiting):
    """The scripted services of a scenario, and the student's program."""

    def __init__(
        self,
        node: Node,
        log: ArenaLog,
        student: Student,
        phases: Phases,
        speed_up: Callable[[], None],
    ) -> None:
        super().__init__(Graph(node, log), log)
        self._node = node
        self._student = student
        self._phases = phases
        self._speed_up = speed_up
        self._services: list[ScriptedService] = []
        self._request_numbers = count(1)
        self._server_numbers = count(1)

    # -- the servers --------------------------------------------------------------------------------------------------

    def offer_service(self, name: str, service_type: Any, *replies: Reply | None) -> ScriptedService:
        """Offer a service whose first request gets the first of `replies`, and so on; the last one is repeated."""
        service = ScriptedService(
            self._node,
            service_type,
            name,
            replies,
            f"server {next(self._server_numbers)}",
            self._log,
            lambda: f"request {next(self._request_numbers)}",
        )
        self._services.append(service)
        return service

    def wait_for_requests(self, service: ScriptedService, number: int, timeout: float) -> bool:
        """Wait for so many requests to a scripted service; False if the time or the program is over first."""
        self.wait_until(lambda: service.requests >= number or self._student.has_exited(), timeout)
        return service.requests >= number

    # -- the student's program ----------------------------------------------------------------------------------------

    def start_program(self, arguments: Sequence[str] = ()) -> None:
        """Run the student's program, and return when it has found the servers, if there are any.

        The clock is sped up only then, because discovery takes real time.
        """
        started = time.monotonic()
        self._student.start(arguments)
        appeared = self.poll_until(self._has_appeared, APPEARING_TIMEOUT)
        if appeared and not self._student.has_exited():
            self._log.append(ev.NodeReady(waited=time.monotonic() - started))
            self._phases.end("discovery")
        if appeared and self._services:
            self._wait_for_matching()
        self._graph.inspect()
        self._speed_up()

    def run_module(self, module: str, arguments: Sequence[str], files: Sequence[str]) -> None:
        """Run a module of ours on some of the student's files, in the student's sandbox, to its end.

        Use it in scenarios in which nothing is timed. A module that takes too long is recorded like such a program.
        """
        self._student.start_module(module, arguments, files)
        self._wait_for_end(MODULE_TIMEOUT)

    def wait_for_end(self) -> None:
        """Wait until the program has ended by itself; if it does not in time, record that."""
        self._wait_for_end(END_TIMEOUT)

    # -- helpers ------------------------------------------------------------------------------------------------------

    def _wait_for_matching(self) -> None:
        """Wait until the program's clients are discovered, and a moment longer for its own side, or for a request."""

        def is_needless() -> bool:
            return self._had_a_request() or self._student.has_exited()

        def are_known() -> bool:
            return all(self._graph.count_clients(service.name) for service in self._services)

        self.poll_until(lambda: is_needless() or are_known(), MATCHING_TIMEOUT)
        self.wait_until(is_needless, SETTLING)

    def _wait_for_end(self, timeout: float) -> None:
        started = time.monotonic()
        if not self.wait_until(self._student.has_exited, timeout):
            waited = time.monotonic() - started
            self._log.append(ev.Unanswered(what="end", id="program", waited=waited))

    def _had_a_request(self) -> bool:
        return any(service.requests for service in self._services)

    def _has_appeared(self) -> bool:
        """Return whether there is a node beside ours, or the program has ended."""
        return self._student.has_exited() or self._graph.has_another_node()
