"""What every stage has: time on the arena's clock, and waiting for things to happen."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.graph import Graph

FLOOD = 50  # messages within…
QUIET = 0.25  # s of the arena's clock are more than any sound node sends
FLOODED = 15.0  # s of it are waited for the end of a flood
POLLING = 0.005  # s between two looks at what nobody notifies us of, such as changes of the graph


class Waiting:
    """Waits for what the log says; all durations are seconds on the arena's clock."""

    def __init__(self, graph: Graph, log: ArenaLog) -> None:
        self._graph = graph
        self._log = log

    def wait(self, duration: float) -> None:
        """Let time pass."""
        deadline = time.monotonic() + duration
        while (left := deadline - time.monotonic()) > 0:
            time.sleep(left)

    def wait_until(self, condition: Callable[[], Any], timeout: float) -> bool:
        """Wait for a condition on the log; False when the time is over first."""
        return self._log.wait_until(condition, timeout)

    def poll_until(self, condition: Callable[[], Any], timeout: float) -> bool:
        """Wait for a condition of which nobody is notified; False when the time is over first."""
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > deadline:
                return False
            time.sleep(POLLING)
        return True

    def close(self) -> None:
        """The scenario is over: take in what was sent before, and record what there was too much of."""
        self._take_in_the_rest()
        self._graph.inspect()
        self._log.finish()

    def _take_in_the_rest(self) -> None:
        """Wait until nothing is left of a flood: behind it may stand in line what convicts the node."""
        deadline = time.monotonic() + FLOODED
        before = self._log.received
        while True:
            self.wait(QUIET)
            now = self._log.received
            if now - before < FLOOD:
                return
            if time.monotonic() > deadline:
                self._log.drop("unread")
                return
            before = now

    def mark(self, name: str) -> None:
        """Name this moment for the checks."""
        self._log.append(ev.Mark(name=name))
