"""Checks messages of students' nodes before they are unpacked: their size, and whether they can be read at all."""

from __future__ import annotations

from array import array
from collections.abc import Mapping
from typing import Any

import numpy as np

from autograder.arena.arena_log import ArenaLog
from ros_runtime.messages import is_message
from ros_runtime.recorded_client.conversation import Reading

KIB = 1024
LARGEST: Mapping[str, int] = {  # bytes; messages in correct use of the course's interfaces have a few hundred
    "feedback": 16 * KIB,
    "status": 64 * KIB,  # two thousand goals
    "answer": 64 * KIB,
    "result": 64 * KIB,
    "cancel answer": 64 * KIB,
    "request": 64 * KIB,
    "message": 64 * KIB,
}


class BoundedReading(Reading):
    """Limits the size and the number of messages; records the others as too large or dropped, unread."""

    def __init__(self, log: ArenaLog) -> None:
        self._log = log

    def admits(self, what: str, of: str) -> bool:
        """Return whether to read one more event of a kind; `of` names its goal, call or service, or is UNKNOWN_GOAL."""
        return self._log.admits(what, of)

    def is_too_large(self, what: str, id: str, message: Any) -> bool:
        """Return whether a message is too large to be read, and record it if so."""
        return self._has_too_many_bytes(what, id, size_of(message))

    def unpack(self, what: str, id: str, data: bytes, message_type: Any) -> Any | None:
        """Return the message in serialized `data`; record why and return None if it is too large or malformed."""
        if self._has_too_many_bytes(what, id, len(data)):
            return None
        try:
            return super().unpack(what, id, data, message_type)
        except Exception:  # the middleware's own error, which has no public name
            self._log.drop("unreadable")
            return None

    def _has_too_many_bytes(self, what: str, id: str, size: int) -> bool:
        if size <= LARGEST[what]:
            return False
        self._log.too_large(what, id, size, LARGEST[what])
        return True


def size_of(message: Any) -> int:
    """Estimate the bytes of a message from the lengths of its texts and lists, without copying them.

    Of a very long list only the length counts, so that a large message takes no longer.
    """
    if is_message(message):
        return sum(size_of(getattr(message, name)) for name in message.get_fields_and_field_types())
    if isinstance(message, str | bytes | bytearray):
        return 4 + len(message)
    if isinstance(message, np.ndarray):
        return 4 + int(message.nbytes)
    if isinstance(message, array):
        return 4 + len(message) * message.itemsize
    if isinstance(message, list | tuple):
        if len(message) > max(LARGEST.values()):
            return 4 + len(message)
        return 4 + sum(size_of(element) for element in message)
    return 8
