"""What was said between the notebook, the servers and the robot: the material of a sequence diagram.

A call or a goal begins a story unless something is under way already: so a goal, its cancel and a second goal that
takes its place are one story, and the next cell's call is another.
"""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass

from ros_runtime.drawing.sequence_diagram import Kind

NOTEBOOK = "notebook"


@dataclass(frozen=True)
class Said:
    """One arrow. `repeats`: it is one of a stream, of which a diagram need not show every one."""

    time: float
    sender: str
    receiver: str
    label: str
    kind: Kind
    repeats: bool


_lock = threading.Lock()
_told: list[Said] = []
_under_way: set[object] = set()


def begin(matter: object, *, continues: bool = False) -> None:
    """Something is under way until `end(matter)`. A new story begins, unless it `continues` one or one is going on."""
    with _lock:
        if not _under_way and not continues:
            _told.clear()
        _under_way.add(matter)


def end(matter: object) -> None:
    """It is over: answered, or no longer waited for."""
    with _lock:
        _under_way.discard(matter)


def tell(sender: str, receiver: str, label: str, kind: Kind = "message", *, repeats: bool = False) -> None:
    """Write down that `sender` said `label` to `receiver` now."""
    with _lock:
        _told.append(Said(time.monotonic(), sender, receiver, label, kind, repeats))


def told() -> list[Said]:
    """The present story so far, in order of time."""
    with _lock:
        return list(_told)


def forget() -> None:
    """Begin with an empty page, and with nothing under way."""
    with _lock:
        _told.clear()
        _under_way.clear()
