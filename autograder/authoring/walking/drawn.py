"""Steps that are drawn for servers that walk: goals that must be rejected, and numbers that can be read."""

from __future__ import annotations

import math
from random import Random
from typing import Any

NUMBERS = (math.nan, math.inf, -math.inf)


def impossible(random: Random, *more: tuple[str, Any]) -> list[list[Any]]:
    """Return steps that send goals each of which is wrong in one field, in any order; `more` are fields and values."""
    wrong: list[tuple[str, Any]] = [
        ("header.frame_id", random.choice(("base_link", "world", "odometry", "", "odom_combined"))),
        *((f"pose.position.{axis}", random.choice(NUMBERS)) for axis in "xyz"),
        *((f"pose.orientation.{axis}", random.choice(NUMBERS)) for axis in "xyzw"),
        *more,
    ]
    random.shuffle(wrong)
    return [["ask", f"impossible {number}", *each] for number, each in enumerate(wrong, start=1)]


def rounded(value: Any) -> Any:
    """Return the same value, or list of values, with numbers rounded to three decimals."""
    if isinstance(value, list):
        return [rounded(each) for each in value]
    return round(value, 3) if isinstance(value, float) else value
