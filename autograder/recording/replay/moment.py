"""Something that happened in a recorded arena, in words."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Kind(Enum):
    """What a moment is about."""

    EVENT = "event"
    FEEDBACK = "feedback"
    OUTPUT = "output"
    PASSED = "passed"
    FAILED = "failed"
    TROUBLE = "trouble"


@dataclass(frozen=True)
class Moment:
    """What happened at `t` (s on the arena's clock)."""

    t: float
    kind: Kind
    text: str


@dataclass(frozen=True)
class Verdict:
    """What a check found, at `t` (s)."""

    t: float
    check: str
    text: str
    failed: bool


def readable(text: str) -> str:
    """Return text in one line without control characters, which a program may have printed to move a cursor."""
    return "".join(letter if letter.isprintable() else " " for letter in text)
