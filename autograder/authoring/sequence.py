"""Scenarios that are sequences of steps: whether all steps were carried out, and which ones led to a failure."""

from __future__ import annotations

import math
from collections.abc import MutableSequence, Sequence
from random import Random
from typing import Any

from autograder.authoring.diagnosis.missing import Missing
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript

STEPS = "steps"  # the input of a scenario that is a sequence
NOT_FINITE = (math.nan, math.inf, -math.inf)


def shuffled(random: Random, blocks: MutableSequence[list[Any]]) -> list[Any]:
    """Shuffle blocks of steps, and return the steps."""
    random.shuffle(blocks)
    return [step for block in blocks for step in block]


def rounded(value: Any) -> Any:
    """Return the same value, or list of values, with numbers rounded to three decimals."""
    if isinstance(value, list):
        return [rounded(each) for each in value]
    return round(value, 3) if isinstance(value, float) else value


def require_all_steps(run: Transcript) -> None:
    """Require that every step was carried out, if the scenario is a sequence."""
    steps = run.params.get(STEPS, ())
    if (done := len(_ends(run))) < len(steps):
        step = in_words(run, steps[: done + 1])[-1]
        raise Missing(
            run,
            expected=f"a program that gets as far as step {done + 1} of the scenario, “{step}”",
            never="that step was not completed",
        )


def steps_until(run: Transcript, t: float | None) -> Sequence[Any]:
    """Return the steps begun by time `t` (s; None: all steps); empty if the scenario is not a sequence."""
    steps = run.params.get(STEPS, ())
    return steps if t is None else steps[: 1 + sum(end < t for end in _ends(run))]


def in_words(run: Transcript, steps: Sequence[Any]) -> list[str]:
    """Return a run's first steps to read, as the arena worded them; as data if it did not get so far."""
    planned = run.first(ev.StepsPlanned)
    return planned.words[: len(steps)] if planned else [" ".join(map(str, step)) for step in steps]


def _ends(run: Transcript) -> list[float]:
    """Return when (s) each step ended, in order, up to the first one that did not end."""
    steps = run.params.get(STEPS, ())
    marks = {mark.name: mark.t for mark in run.all(ev.Mark)}
    ends: list[float] = []
    for number in range(1, len(steps) + 1):
        if (end := marks.get(f"step {number}")) is None:
            break
        ends.append(end)
    return ends
