"""Which submissions are enough to prove every check once, for those who cannot wait for all of them."""

from __future__ import annotations

import re
from collections.abc import Sequence

from autograder.audit.known_submission import KnownSubmission

_MISCONCEPTION = re.compile(r"\(M\d+\)")


def enough_to_prove(
    submissions: Sequence[KnownSubmission], of_each: int | None = None
) -> list[KnownSubmission]:
    """Return as few faulty submissions as name every check and misconception, with correct and hostile ones.

    Of the latter the first `of_each` of either kind, or all. Greedy: the faulty one that names most of what is still
    to be proved comes first.
    """
    chosen = {
        known.path
        for kind in ("correct", "hostile")
        for known in [known for known in submissions if known.kind == kind][:of_each]
    }
    left = {known: _proves(known) for known in submissions if known.kind == "faulty"}
    proved: set[str] = set()
    while left:
        best = max(left, key=lambda known: len(left[known] - proved))
        if not left[best] - proved:
            break
        proved |= left.pop(best)
        chosen.add(best.path)
    return [known for known in submissions if known.path in chosen]


def _proves(known: KnownSubmission) -> set[str]:
    return {*known.caught_by, *_MISCONCEPTION.findall(known.about)}
