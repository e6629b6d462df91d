"""What students' nodes send, looked at before it is unpacked: how large it is, and whether it can be read at all."""

from __future__ import annotations

from array import array
from collections.abc import Mapping
from typing import Any

import numpy as np
from rclpy.serialization import deserialize_message

from autograder.arena.recorder import Recorder

KIB = 1024
LARGEST: Mapping[str, int] = {  # bytes; what the course's interfaces are used for has a few hundred
    "feedback": 16 * KIB,
    "status": 64 * KIB,  # two thousand goals
    "answer": 64 * KIB,
    "result": 64 * KIB,
    "cancel answer": 64 * KIB,
    "request": 64 * KIB,
}


def unpack(what: str, id: str, data: bytes, message_type: Any, recorder: Recorder) -> Any | None:
    """Return the message, or None and a record of why not."""
    if is_too_large(what, id, len(data), recorder):
        return None
    try:
        return deserialize_message(data, message_type)
    except Exception:  # the middleware's own error, which has no public name
        recorder.drop("unreadable")
        return None


def is_too_large(what: str, id: str, size: int, recorder: Recorder) -> bool:
    """Whether something of so many bytes is more than is read; recorded when it is."""
    if size <= LARGEST[what]:
        return False
    recorder.too_large(what, id, size, LARGEST[what])
    return True


def size_of(message: Any) -> int:
    """About how many bytes a message has, from the lengths of its texts and lists: nothing is copied.

    A long list is counted by its length alone, so that this takes no longer for a large message.
    """
    if hasattr(message, "get_fields_and_field_types"):
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
