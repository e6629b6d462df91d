"""Arranges labels on a time axis in rows, so that no label overlaps another label or its line."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

FONT_SIZE = 9.0  # points
ROW = 0.19  # inches, the height of a row
GAP = 0.12  # inches, between a label and the next line to its right


class Mark(NamedTuple):
    """A label at a `time` (s) of the axis."""

    time: float
    label: str


def rows_of(marks: Sequence[Mark], inches_per_second: float) -> list[int]:
    """Return the row of each label, 0 at the top. Marks are in order of time; a label is to the right of its line.

    If a label's line would cross an earlier label, the label gets a row below the earlier one.
    """
    rows: list[int] = []
    for mark in marks:
        covering = [
            row
            for row, earlier in zip(rows, marks, strict=False)
            if (mark.time - earlier.time) * inches_per_second < text_width(earlier.label) + GAP
        ]
        rows.append(max(covering, default=-1) + 1)
    return rows


@cache
def text_width(text: str) -> float:
    """Return the width of a label, in inches."""
    from matplotlib.textpath import TextPath  # takes a while to import, and most notebooks draw nothing

    if not text.strip():
        return 0.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a character that is missing in the font is measured as a box
        return TextPath((0, 0), text.replace("$", r"\$"), size=FONT_SIZE).get_extents().width / 72


def overhang(marks: Sequence[Mark], end: float, inches_per_second: float) -> float:
    """Return how far the labels extend beyond the `end` (s) of the axis, in inches; at least 0."""
    ends = [(mark.time - end) * inches_per_second + text_width(mark.label) + GAP for mark in marks]
    return max(0.0, *ends) if ends else 0.0
