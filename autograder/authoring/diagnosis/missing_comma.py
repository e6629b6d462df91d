"""Where a comma is missing between two strings, which Python joins: the error is raised in another line."""

from __future__ import annotations

import tokenize
from collections.abc import Mapping
from io import StringIO
from itertools import pairwise

_ADVICE = "Look for a missing comma"


def with_comma(help: str, sources: Mapping[str, str]) -> str:
    """Return advice to look for a missing comma with the line, if two strings stand side by side in just one.

    `sources` are the texts of the program's files by name.
    """
    lines = [f" in line {line} of {name}" for name, text in sources.items() for line in _joined_strings(text)]
    return help.replace(_ADVICE, _ADVICE + lines[0]) if len(lines) == 1 else help


def _joined_strings(text: str) -> list[int]:
    try:
        tokens = list(tokenize.generate_tokens(StringIO(text).readline))
    except (SyntaxError, tokenize.TokenError):
        return []
    strings = [(a, b) for a, b in pairwise(tokens) if a.type == b.type == tokenize.STRING]
    return [a.end[0] for a, b in strings if a.end[0] == b.start[0]]
