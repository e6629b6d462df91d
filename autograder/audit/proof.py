"""What is enough to prove every check once, for those who cannot wait for every submission and every check."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from autograder.audit.known_submission import KnownSubmission
from autograder.engine.exercise import Exercise

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


def enough_to_catch(known: KnownSubmission, exercise: Exercise) -> Exercise:
    """Return the exercise with only the checks that a faulty submission names, and those they need.

    For a correct or a hostile one every check stays: what it must not lose counts as much.
    """
    if known.kind != "faulty":
        return exercise
    checks = {check.id: check for check in exercise.checks}
    wanted = list(known.caught_by)
    for check_id in wanted:  # grows as it goes
        wanted += [need for need in checks[check_id].needs if need not in wanted]
    return replace(exercise, checks=[check for check in exercise.checks if check.id in wanted])


def _proves(known: KnownSubmission) -> set[str]:
    return {*known.caught_by, *_MISCONCEPTION.findall(known.about)}
