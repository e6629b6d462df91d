"""A log of events, and waiting for an event in it."""

from __future__ import annotations

import threading
import time
from collections import defaultdict
from collections.abc import Callable
from typing import Any, TypeVar

from ros_runtime.record.event import Event

E = TypeVar("E", bound=Event)

CONDITION_PERIOD = 1.0  # s between two tests of a condition, which may depend on more than the log


class EventLog:
    """Events in the order in which they were appended; thread-safe."""

    def __init__(self) -> None:
        self._events: defaultdict[type[Event], list[Any]] = defaultdict(list)
        self._changed = threading.Condition()

    def append(self, event: Event) -> None:
        """Add an event, and wake up the threads that wait."""
        with self._changed:
            self._events[type(event)].append(event)
            self._changed.notify_all()

    def clear(self) -> None:
        """Remove all events."""
        with self._changed:
            self._events.clear()

    def all(self, kind: type[E], **fields: Any) -> list[E]:
        """Return the events of a type that have these values in these fields."""
        with self._changed:
            return [event for event in self._events[kind] if _has(event, fields)]

    def first(self, kind: type[E], **fields: Any) -> E | None:
        """Return the earliest event of a type with these values in these fields, or None."""
        with self._changed:
            return next((event for event in self._events[kind] if _has(event, fields)), None)

    def last(self, kind: type[E]) -> E | None:
        """Return the latest event of a type, or None."""
        with self._changed:
            return self._events[kind][-1] if self._events[kind] else None

    def count(self, kind: type[Event], **fields: Any) -> int:
        """Count the events of a type that have these values in these fields."""
        with self._changed:
            return (
                sum(_has(event, fields) for event in self._events[kind])
                if fields
                else len(self._events[kind])
            )

    def wait_until(self, condition: Callable[[], Any], timeout: float) -> bool:
        """Wait until a condition on the log is true; return False if `timeout` s pass first."""
        deadline = time.monotonic() + timeout
        with self._changed:
            while not condition():
                left = deadline - time.monotonic()
                if left <= 0:
                    return False
                self._changed.wait(min(left, CONDITION_PERIOD))
        return True


def _has(event: Event, fields: dict[str, Any]) -> bool:
    return all(getattr(event, name) == value for name, value in fields.items())
