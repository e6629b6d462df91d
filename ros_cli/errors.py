"""The error messages of the commands."""

from __future__ import annotations

import shutil
import sys
import textwrap
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from ros_runtime.suggestion import suggestion
from ros_runtime.terminal import is_terminal


class CommandError(Exception):
    """The message says what was seen, what was expected and what to do next; it goes to stderr, with exit status 1."""


def print_message(message: object) -> None:
    """Print a message on stderr; in a terminal its lines are broken between words."""
    lines = str(message).splitlines()
    if is_terminal(sys.stderr):
        width = shutil.get_terminal_size().columns
        lines = [textwrap.fill(line, width, break_long_words=False, break_on_hyphens=False) for line in lines]
    print("\n".join(lines), file=sys.stderr, flush=True)


@contextmanager
def transient_message(text: str) -> Iterator[None]:
    """In a terminal, show a text on stderr while the `with` block runs."""
    if not is_terminal(sys.stderr):
        yield
        return
    print(text, end="", file=sys.stderr, flush=True)
    try:
        yield
    finally:
        print("\r\033[K", end="", file=sys.stderr, flush=True)


def unknown(kind: str, name: str, known: Iterable[str]) -> CommandError:
    """Return the error for a name that is not in the graph; it suggests names that look alike.

    Args:
        kind: "topic", "service", "action" or "node".
        name: the unknown name.
        known: the names in the graph.
    """
    advice = suggestion(name, known, f"`{kind} list` shows the known {kind}s")
    return CommandError(f"Unknown {kind} '{name}': {advice}")
