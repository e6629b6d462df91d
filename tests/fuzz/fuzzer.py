"""A fuzzer of one reader: what Hypothesis makes up, and what must hold for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hypothesis import HealthCheck, given, settings
from hypothesis.strategies import SearchStrategy

_USUAL = settings(deadline=None, database=None, suppress_health_check=list(HealthCheck))
SUITE = settings(_USUAL, max_examples=25, derandomize=True)
LONG = settings(_USUAL, max_examples=20_000, print_blob=True)


@dataclass(frozen=True)
class Fuzzer:
    """What is made up, and what must hold for it.

    Attributes:
        name: of the test.
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

    def look(self, chosen: settings = SUITE) -> None:
        """Try inputs; raise what the smallest raises for which something does not hold."""

        @settings(chosen, max_examples=max(1, round(chosen.max_examples * self.weight)))
        @given(self.inputs)
        def each(value: Any) -> None:
            self.require(value)

        each()
