"""A fuzzer of one reader: what Hypothesis generates, and the properties that must hold for it."""

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
    """A property-based test.

    Attributes:
        name: of the test.
        channel: by which a student's input reaches the reader, such as "files".
        inputs: generates them.
        require: takes an input and raises any exception if a property does not hold.
        weight: factor on the number of examples, above 1 for quick ones.
    """

    name: str
    channel: str
    inputs: SearchStrategy[Any]
    require: Callable[[Any], None]
    weight: float = 1.0

    def run(self, chosen: settings = SUITE) -> None:
        """Try inputs; raise what `require` raises for the smallest one that fails."""

        @settings(chosen, max_examples=max(1, round(chosen.max_examples * self.weight)))
        @given(self.inputs)
        def each(value: Any) -> None:
            self.require(value)

        each()
