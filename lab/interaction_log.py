"""The messages between notebook, servers and robot, from which a sequence diagram is drawn.

A call or a goal starts a new log unless another one is still pending. So a goal, its cancel and a second goal that
replaces it share one log, and the call of the next cell has its own.
"""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass

from ros_runtime.drawing.sequence_diagram import Kind

NOTEBOOK = "notebook"


@dataclass(frozen=True)
class Message:
    """One arrow of the diagram.

    Attributes:
        time: s, on the monotonic clock.
        sender: name of a lifeline.
        receiver: name of a lifeline.
        label: text on the arrow.
        kind: how the arrow is drawn.
        repeats: it is one of a stream, of which the diagram shows only some.
    """

    time: float
    sender: str
    receiver: str
    label: str
    kind: Kind
    repeats: bool


_lock = threading.Lock()
_messages: list[Message] = []
_pending: set[object] = set()


def begin(request: object, *, continues: bool = False) -> None:
    """Mark a request as pending until `end(request)`. Starts a new log, unless it `continues` one or one is pending."""
    with _lock:
        if not _pending and not continues:
            _messages.clear()
        _pending.add(request)


def end(request: object) -> None:
    """Mark a request as no longer pending: it was answered, or the caller has given up."""
    with _lock:
        _pending.discard(request)


def record(sender: str, receiver: str, label: str, kind: Kind = "message", *, repeats: bool = False) -> None:
    """Append a message with the present time."""
    with _lock:
        _messages.append(Message(time.monotonic(), sender, receiver, label, kind, repeats))


def messages() -> list[Message]:
    """The messages of the present log, in order of time."""
    with _lock:
        return list(_messages)


def clear() -> None:
    """Remove all messages and pending requests."""
    with _lock:
        _messages.clear()
        _pending.clear()
