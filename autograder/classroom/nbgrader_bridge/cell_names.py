"""The mapping between an exercise's checks and the grade cells of its notebook; hidden checks are only numbered."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

HIDDEN_HELP = "Not passed. Read the task again sentence by sentence: every sentence of it is checked."


def hidden_help(promise: str) -> str:
    """Return what a student reads about a hidden check that did not pass; `promise`: the clause that it judges."""
    return f"Not passed. It checks {promise}" if promise else HIDDEN_HELP


class Named(Protocol):
    """A check or its verdict."""

    @property
    def id(self) -> str:
        """The name of the check, a Python identifier."""

    @property
    def hidden(self) -> bool:
        """Whether only the instructor's grading makes the check."""


def cell_names(checks: Sequence[Named]) -> dict[str, str]:
    """Return the grade_id of each check's cell by the check's id.

    The cell of a visible check has the check's id. That of a hidden one is only numbered, because students see it.
    """
    names: dict[str, str] = {}
    hidden = 0
    for check in checks:
        hidden += check.hidden
        names[check.id] = f"hidden_{hidden}" if check.hidden else check.id
    return names
