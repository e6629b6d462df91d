"""The error messages of the commands."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


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


def suggestion(name: str, known: Iterable[str], otherwise: str) -> str:
    """Return a question that suggests a known name; `otherwise` if no name is similar.

    A similar name has the same ending (/robot/odom for /odom) or differs in few letters.
    """
    names = sorted(known)
    end = "/" + name.rpartition("/")[2]
    alike = [each for each in names if each.endswith(end)] or get_close_matches(name, names, n=2)
    return f"did you mean {' or '.join(alike)}?" if alike else otherwise
