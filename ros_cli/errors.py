"""The error messages of the commands."""

from __future__ import annotations

from collections.abc import Iterable

from ros_runtime.suggestion import suggestion


class CommandError(Exception):
    """The message says what was seen, what was expected and what to do next; it goes to stderr, with exit status 1."""


def unknown(kind: str, name: str, known: Iterable[str]) -> CommandError:
    """Return the error for a name that is not in the graph; it suggests names that look alike.

    Args:
        kind: "topic", "service", "action" or "node".
        name: the unknown name.
        known: the names in the graph.
    """
    advice = suggestion(name, known, f"`{kind} list` shows the known {kind}s")
    return CommandError(f"Unknown {kind} '{name}': {advice}")
