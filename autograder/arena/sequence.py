"""A scenario as a sequence of steps from a vocabulary, written down by an author or drawn from a seed.

ASK_TWICE = Scenario("in_order", {"steps": [["ask", 1], ["set_battery", 0.35], ["ask", 1]]})
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from autograder.arena.offering import Offering

Steps = Sequence[Sequence[Any]]  # each is [verb, *arguments]


def carry_out(stage: Offering, steps: Steps, vocabulary: Mapping[str, Callable[..., object]]) -> None:
    """Carry out the steps in order and mark the end of each; stop at a step that returns False (no answer)."""
    for number, (verb, *arguments) in enumerate(steps, start=1):
        if vocabulary[verb](*arguments) is False:
            return
        stage.mark(f"step {number}")
