"""A fuzzer of one reader: Hypothesis makes inputs up from a seed, and makes the one that fails as small as it can."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import hypothesis
from hypothesis import HealthCheck, Phase, Verbosity
from hypothesis.strategies import SearchStrategy

from fuzz.finding import Finding

LONGEST_INPUT = 200_000  # characters that are kept of one that failed


@dataclass(frozen=True)
class Fuzzer:
    """What is made up, and what must hold for it.

    Attributes:
        name: as in `course test --fuzz-only NAME`.
        channel: what of a student's it stands for.
        inputs: makes them.
        require: takes an input and raises whatever it likes if something does not hold.
        weight: its examples are so many times the usual number, because they are quick.
    """

    name: str
    channel: str
    inputs: SearchStrategy[Any]
    require: Callable[[Any], None]
    weight: float = 1.0

    def look(self, seed: int, examples: int) -> Finding | None:
        """Try so many inputs, the same for the same seed, and return the smallest that failed."""
        latest: list[Any] = []

        @hypothesis.seed(seed)
        @hypothesis.settings(
            max_examples=max(1, round(examples * self.weight)),
            database=None,
            deadline=None,
            derandomize=False,
            report_multiple_bugs=False,
            verbosity=Verbosity.quiet,
            phases=(Phase.generate, Phase.shrink),
            suppress_health_check=list(HealthCheck),
        )
        @hypothesis.given(self.inputs)
        def each(value: Any) -> None:
            latest[:] = [value]
            self.require(value)

        try:
            each()
        except Exception:  # what an input may do to a reader is not listed: that is what is looked for
            shown = repr(latest[0])[:LONGEST_INPUT] if latest else "no input could be made"
            return Finding(self.name, seed, traceback.format_exc(), shown)
        return None
