"""Suggests the known name that a misspelled one probably stands for."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

LEAST_BEGINNING = 3  # letters of a name by which others that begin with them are found
DIFFERENT_NAMESPACE = 0.8  # the least similarity (0 to 1) of two full names whose namespaces differ


def suggestion(name: str, known: Iterable[str], otherwise: str) -> str:
    """Return a question that suggests a known name; `otherwise` if no name is similar.

    A similar name has the same ending (/robot/odom for /odom) or beginning (battery_guard for battery), or differs in
    few letters: first those in the same namespace, whose own common letters do not count, then others.
    """
    names = sorted(known)
    namespace, _, word = name.rpartition("/")
    beside = {last: each for each in names for space, _, last in [each.rpartition("/")] if space == namespace}
    alike = (
        [each for each in names if each.endswith(f"/{word}")]
        or [each for last, each in beside.items() if len(word) >= LEAST_BEGINNING and last.startswith(word)]
        or [beside[last] for last in get_close_matches(word, beside, n=2)]
        or get_close_matches(name, names, n=2, cutoff=DIFFERENT_NAMESPACE)
    )
    return f"did you mean {' or '.join(alike)}?" if alike else otherwise
