"""The captions to show at a time of a recording: recent events and failed checks."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import NamedTuple

from autograder.recording.replay.recording import Kind, Moment

MAX_LINES = 4  # of captions, without the line with the time
EVENT_DURATION = 2.5  # s for which an event is shown; a failed check stays
FEEDBACK_DURATION = 1.0  # s
COLOURS = {
    Kind.EVENT: "#e8e8e8",
    Kind.FEEDBACK: "#8fb8de",
    Kind.OUTPUT: "#9ad0d0",
    Kind.PASSED: "#7fd67f",
    Kind.FAILED: "#ff7b72",
    Kind.WARNING: "#f0c674",
}
TIME_COLOUR = "#ffffff"


class Caption(NamedTuple):
    """A line of text in a colour, #rrggbb."""

    text: str
    colour: str


def captions(t: float, moments: Sequence[Moment], width: int) -> list[Caption]:
    """Return the time (s) and the recent moments, the newest last, in lines of at most `width` characters.

    Failed checks stay visible. If there are too many lines, failed checks come first, then the newest moments.
    """
    shown = [moment for moment in moments if _is_shown(moment, t)]
    feedback = [moment for moment in shown if moment.kind is Kind.FEEDBACK][-1:]
    shown = [moment for moment in shown if moment.kind is not Kind.FEEDBACK or moment in feedback]
    left, chosen = MAX_LINES, []
    for moment in sorted(shown, key=lambda each: (each.kind is not Kind.FAILED, -each.t)):
        wanted = 3 if moment.kind is Kind.FAILED else 1
        lines = _wrapped(moment.text, width, min(wanted, left))
        if not lines:
            break
        left -= len(lines)
        chosen.append((moment, lines))
    return [
        Caption(f"{t:.2f} s", TIME_COLOUR),
        *(
            Caption(text, COLOURS[moment.kind])
            for moment, lines in sorted(chosen, key=lambda each: each[0].t)
            for text in lines
        ),
    ]


def _is_shown(moment: Moment, t: float) -> bool:
    if moment.t > t:
        return False
    if moment.kind is Kind.FAILED:
        return True
    return t - moment.t <= (FEEDBACK_DURATION if moment.kind is Kind.FEEDBACK else EVENT_DURATION)


def _wrapped(text: str, width: int, max_lines: int) -> list[str]:
    return textwrap.wrap(text, width, max_lines=max_lines, placeholder=" …") if max_lines > 0 else []
