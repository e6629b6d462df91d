"""Selects known submissions and checks that prove every check once, for an audit that takes minutes."""

from __future__ import annotations

import random
import re
from collections.abc import Sequence
from dataclasses import replace

from autograder.classroom.audit.known_submission import KnownSubmission
from autograder.engine.exercise import Exercise

_MISCONCEPTION = re.compile(r"\(M\d+\)")


def enough_to_prove(
    submissions: Sequence[KnownSubmission], of_each: int | None = None
) -> list[KnownSubmission]:
    """Return a small set of faulty submissions whose headers cover every check and misconception, plus other kinds.

    The faulty ones are a greedy set cover. Of the correct and of the hostile ones the first `of_each` are taken (None:
    all).
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


def some_that_walk(
    submissions: Sequence[KnownSubmission], exercise: Exercise, faulty: int
) -> list[KnownSubmission]:
    """Return a correct submission, and `faulty` ones that must fail checks in which a robot walks; none without it.

    The exercise's name draws them.
    """
    walked = {
        check.id for check in exercise.checks if any(scenario.robot is not None for scenario in check.on)
    }
    if not walked:
        return []
    faults = [known for known in submissions if known.kind == "faulty" and known.caught_by]
    faults = [known for known in faults if walked.issuperset(known.caught_by)]
    draw = random.Random(exercise.name)
    correct = [known for known in submissions if known.kind == "correct"]
    return [draw.choice(correct), *draw.sample(faults, faulty)]


def enough_to_catch(known: KnownSubmission, exercise: Exercise) -> Exercise:
    """Return the exercise with only the checks that tell whether a faulty or hostile submission is caught.

    Faulty: the checks that it must fail, without their prerequisites, which it passes. Hostile: the checks that it must
    or may fail, with their prerequisites, because the machine decides which one its attack affects first. If it must
    fail none, all checks stay.
    """
    checks = {check.id: check for check in exercise.checks}
    if known.kind == "faulty":
        alone = [replace(checks[check_id], needs=()) for check_id in checks if check_id in known.caught_by]
        return replace(exercise, checks=alone)
    if not known.caught_by:
        return exercise
    wanted = [*known.caught_by, *known.also_fails]
    for check_id in wanted:  # the loop appends to this list
        wanted += [need.id for need in checks[check_id].needs if need.id not in wanted]
    return replace(exercise, checks=[check for check in exercise.checks if check.id in wanted])


def _proves(known: KnownSubmission) -> set[str]:
    return {*known.caught_by, *_MISCONCEPTION.findall(known.about)}
