"""Suggests the known name that a misspelled one probably stands for."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


def suggestion(name: str, known: Iterable[str], otherwise: str) -> str:
    """Return a question that suggests a known name; `otherwise` if no name is similar.

    A similar name has the same ending (/robot/odom for /odom) or differs in few letters.
    """
    names = sorted(known)
    end = "/" + name.rpartition("/")[2]
    alike = [each for each in names if each.endswith(end)] or get_close_matches(name, names, n=2)
    return f"did you mean {' or '.join(alike)}?" if alike else otherwise
