"""One message of a recording, and the names that are shared by the writer and the reader of recordings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from builtin_interfaces.msg import Time

# Version of metadata and channels; it is increased when `course replay` can no longer read older files.
FORMAT = "1"
METADATA = "course_recording"

EVENTS = "/arena/events"  # descriptions of the events (rcl_interfaces/Log)
ROSOUT = "/rosout"  # the program's output, and the verdicts (rcl_interfaces/Log)
CHECKS = "course.checks"  # the logger's name in the log messages of verdicts


@dataclass(frozen=True)
class Entry:
    """A message on a topic.

    Attributes:
        t: time since the arena's start, s on the arena's clock.
        topic: full name of the topic.
        message: a ROS message.
        essential: whether the message is never left out, even if the student's program floods the recording. Ground
            truth and verdicts are essential.
    """

    t: float
    topic: str
    message: Any
    essential: bool = False


def stamp(t: float) -> Time:
    """Return a time on the arena's clock as a ROS message."""
    nanoseconds = as_nanoseconds(t)
    return Time(sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9)


def as_nanoseconds(t: float) -> int:
    """Return a time on the arena's clock as an MCAP time in ns; a recording begins at 0."""
    return min(max(0, round(t * 1e9)), 2**31 * 10**9 - 1)


def full_name(namespace: str, name: str) -> str:
    """Return the full name of a topic, service or action of a node in a namespace."""
    return name if name.startswith("/") else f"{namespace.rstrip('/')}/{name}"
