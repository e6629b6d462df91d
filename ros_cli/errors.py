"""The error messages of the commands."""

from __future__ import annotations

import shutil
import sys
import textwrap
from collections.abc import Iterable
from difflib import get_close_matches

from ros_runtime.terminal import is_terminal

DIFFERENT_NAMESPACE = 0.8  # the least similarity (0 to 1) of two full names whose namespaces differ


class CommandError(Exception):
    """The message says what was seen, what was expected and what to do next; it goes to stderr, with exit status 1."""


def print_message(message: object) -> None:
    """Print a message on stderr; in a terminal its lines are broken between words."""
    lines = str(message).splitlines()
    if is_terminal(sys.stderr):
        width = shutil.get_terminal_size().columns
        lines = [textwrap.fill(line, width, break_long_words=False, break_on_hyphens=False) for line in lines]
    print("\n".join(lines), file=sys.stderr, flush=True)


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

    A similar name has the same ending (/robot/odom for /odom) or differs in few letters: first those in the same
    namespace, whose own common letters do not count, then others.
    """
    names = sorted(known)
    namespace, _, word = name.rpartition("/")
    beside = {last: each for each in names for space, _, last in [each.rpartition("/")] if space == namespace}
    alike = (
        [each for each in names if each.endswith(f"/{word}")]
        or [beside[last] for last in get_close_matches(word, beside, n=2)]
        or get_close_matches(name, names, n=2, cutoff=DIFFERENT_NAMESPACE)
    )
    return f"did you mean {' or '.join(alike)}?" if alike else otherwise
