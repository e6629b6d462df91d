"""What every stage can do: wait, on the arena's clock, for time to pass or something to happen."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.graph import Graph

FLOOD = 50  # messages within QUIET; no correct node sends as many
QUIET = 0.25  # s on the arena's clock
FLOODED = 15.0  # s on the arena's clock to wait for the end of a flood
POLLING = 0.005  # s between two polls of a state without notification, such as the graph


class Waiting:
    """Waits for time or for events in the log; all durations are seconds on the arena's clock."""

    def __init__(self, graph: Graph, log: ArenaLog) -> None:
        self._graph = graph
        self._log = log

    def wait(self, duration: float) -> None:
        """Let time pass."""
        deadline = time.monotonic() + duration
        while (left := deadline - time.monotonic()) > 0:
            time.sleep(left)

    def wait_until(self, condition: Callable[[], Any], timeout: float) -> bool:
        """Wait for a condition on the log; return False if the time is over first."""
        return self._log.wait_until(condition, timeout)

    def poll_until(self, condition: Callable[[], Any], timeout: float) -> bool:
        """Poll a condition that is not about the log; return False if the time is over first."""
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > deadline:
                return False
            time.sleep(POLLING)
        return True

    def close(self) -> None:
        """End the scenario: record the messages still in transit, and which limits were exceeded."""
        self._drain_messages()
        self._graph.inspect()
        self._log.finish()

    def _drain_messages(self) -> None:
        """Wait until a flood of messages is processed: evidence against the node may be queued behind it."""
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
