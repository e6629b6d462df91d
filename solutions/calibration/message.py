"""The numbers in a text: means, and a count."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import combinations

TOLERANCE = 0.001  # rad/s
LONGEST_COUNT = 12  # characters
_NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_MOST = 20  # numbers of which triples are made


def numbers_in(text: str) -> list[str]:
    """Return the numbers in a text as they are written, also in scientific notation."""
    return _NUMBER.findall(text.replace("\N{MINUS SIGN}", "-"))


def triples_in(numbers: Sequence[str]) -> list[tuple[str, ...]]:
    """Return every three numbers in their order, first those that stand together: names of axes may be between."""
    together = list(zip(numbers, numbers[1:], numbers[2:], strict=False))
    return list(dict.fromkeys([*together, *combinations(numbers[:_MOST], 3)]))


def decimals(number: str) -> int:
    """Return how many decimals a number has: four in 0.0123, and in 1.23e-02."""
    mantissa, _, exponent = number.lower().partition("e")
    if len(exponent) > LONGEST_COUNT:
        return 0
    return len(mantissa.partition(".")[2]) - int(exponent or 0)


def whole_numbers(text: str) -> list[int]:
    """Return the whole numbers in a text; one of thousands of digits, which Python refuses to read, is no count."""
    short = (number.removesuffix(".") for number in numbers_in(text) if len(number) <= LONGEST_COUNT)
    return [int(number) for number in short if number.lstrip("+-").isdigit()]


def is_near(
    found: Iterable[float | str], others: Iterable[float | str], tolerance: float = TOLERANCE
) -> bool:
    """Return whether each component, a number or as it is written, is within the tolerance (rad/s)."""
    return all(abs(float(one) - float(other)) <= tolerance for one, other in zip(found, others, strict=True))


def shown_vector(vector: Sequence[float]) -> str:
    """Return a vector as it is shown in a report."""
    return "(" + ", ".join(f"{value:.4f}" for value in vector) + ")"
