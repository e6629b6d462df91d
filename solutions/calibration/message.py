"""Finds the numbers in a response's message: the means and the number of samples."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import combinations

TOLERANCE = 0.001  # rad/s
MAX_COUNT_LENGTH = 12  # characters
_NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_MAX_NUMBERS = 20  # from which triples are made


def numbers_in(text: str) -> list[str]:
    """Return the numbers in a text as strings, also those in scientific notation."""
    return _NUMBER.findall(text.replace("\N{MINUS SIGN}", "-"))


def triples_in(numbers: Sequence[str]) -> list[tuple[str, ...]]:
    """Return all triples of numbers in their order, consecutive ones first."""
    together = list(zip(numbers, numbers[1:], numbers[2:], strict=False))
    return list(dict.fromkeys([*together, *combinations(numbers[:_MAX_NUMBERS], 3)]))


def decimals(number: str) -> int:
    """Return the number of decimals: four for 0.0123 and for 1.23e-02."""
    mantissa, _, exponent = number.lower().partition("e")
    if len(exponent) > MAX_COUNT_LENGTH:
        return 0
    return len(mantissa.partition(".")[2]) - int(exponent or 0)


def whole_numbers(text: str) -> list[int]:
    """Return the whole numbers in a text, without very long ones, which are no counts and which Python cannot parse."""
    short = (number.removesuffix(".") for number in numbers_in(text) if len(number) <= MAX_COUNT_LENGTH)
    return [int(number) for number in short if number.lstrip("+-").isdigit()]


def is_near(
    found: Iterable[float | str], others: Iterable[float | str], tolerance: float = TOLERANCE
) -> bool:
    """Return whether each component, a number or a string, is within the tolerance (rad/s)."""
    return all(abs(float(one) - float(other)) <= tolerance for one, other in zip(found, others, strict=True))


def shown_vector(vector: Sequence[float]) -> str:
    """Return a vector in words, for a report."""
    return "(" + ", ".join(f"{value:.4f}" for value in vector) + ")"
