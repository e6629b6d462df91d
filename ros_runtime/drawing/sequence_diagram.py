"""A UML sequence diagram as SVG: lifelines from left to right, time from top to bottom."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from textwrap import wrap
from typing import Literal

from ros_runtime.drawing.svg import escape, svg

Kind = Literal["request", "answer", "message"]

LEAST_LANE_WIDTH = 130  # px
ROW_HEIGHT = 30
LEFT = 70  # px, for the times
TOP = 74
BOTTOM = 20
NOTE_GAP = 10  # px between a note's dot and its text
LETTER_WIDTH = 8  # px, of the widest letter
LINE_LENGTH = 20  # characters; a longer label gets more lines: three lanes fit beside the robot's panel
LINE_HEIGHT = 15  # px
COLOURS = {"request": "#1f5fa8", "answer": "#2c7a3f", "message": "#595959"}
DASHES = {"request": "", "answer": ' stroke-dasharray="7 4"', "message": ' stroke-dasharray="2 3"'}


@dataclass(frozen=True)
class Arrow:
    """A message with the text `label` that `sender` sends to `receiver` at `time` (s).

    An arrow from a participant to itself is drawn as a note.
    """

    time: float
    sender: str
    receiver: str
    label: str
    kind: Kind = "message"


def sequence_svg(arrows: Sequence[Arrow], *, title: str, participants: Sequence[str] | None = None) -> str:
    """Draw arrows in order of time; `participants` fixes the order of the lifelines (default: as they appear).

    Requests are solid, answers dashed, messages dotted. The drawing has a text alternative.

    Raises:
        ValueError: there is nothing to draw.
    """
    if not arrows:
        raise ValueError("a sequence diagram needs at least one arrow; nothing has happened yet")
    ordered = sorted(arrows, key=lambda arrow: arrow.time)
    lanes = list(
        dict.fromkeys([*(participants or ()), *(name for a in ordered for name in (a.sender, a.receiver))])
    )
    lane_width = max(LEAST_LANE_WIDTH, *(_room(arrow, lanes) for arrow in ordered))
    centre = {name: LEFT + lane_width // 2 + index * lane_width for index, name in enumerate(lanes)}
    notes = [
        centre[a.sender] + NOTE_GAP + LETTER_WIDTH * len(a.label) for a in ordered if a.sender == a.receiver
    ]
    width = max(LEFT + lane_width * len(lanes), *notes, 0)
    rows = list(accumulate((_row_height(arrow) for arrow in ordered), initial=TOP))[1:]
    height = rows[-1] + ROW_HEIGHT + BOTTOM
    parts: list[str] = []
    for name, x in centre.items():
        parts += _lifeline(name, x, lane_width, height)
    for y, arrow in zip(rows, ordered, strict=True):
        parts += _arrow(arrow, centre, y)
    return svg(parts, width=width, height=height, title=title, words=_in_words(ordered))


def _room(arrow: Arrow, lanes: Sequence[str]) -> int:
    """Return the width (px) of lanes between which the label of an arrow fits."""
    crossed = abs(lanes.index(arrow.sender) - lanes.index(arrow.receiver))
    return LETTER_WIDTH * max(map(len, _lines(arrow))) // crossed if crossed else 0


def _lines(arrow: Arrow) -> list[str]:
    if arrow.sender == arrow.receiver or len(arrow.label) <= LINE_LENGTH:
        return [arrow.label]
    return wrap(arrow.label, LINE_LENGTH, break_long_words=False)


def _row_height(arrow: Arrow) -> int:
    return ROW_HEIGHT + LINE_HEIGHT * (len(_lines(arrow)) - 1)


def _lifeline(name: str, x: int, lane_width: int, height: int) -> list[str]:
    half = lane_width // 2 - 12
    return [
        f'<line x1="{x}" y1="{TOP}" x2="{x}" y2="{height - BOTTOM}" stroke="#888888"/>',
        f'<rect x="{x - half}" y="{TOP - 34}" width="{2 * half}" height="28" rx="5" fill="#eef3f9" stroke="#8aa4c0"/>',
        f'<text x="{x}" y="{TOP - 15}" text-anchor="middle">{escape(name)}</text>',
    ]


def _arrow(arrow: Arrow, centre: dict[str, int], y: int) -> list[str]:
    start, end, colour = centre[arrow.sender], centre[arrow.receiver], COLOURS[arrow.kind]
    halo = 'stroke="#ffffff" stroke-width="4" paint-order="stroke"'  # lifelines do not cross letters
    time = f'<text x="12" y="{y + 4}" fill="#595959" font-size="12">{arrow.time:.2f} s</text>'
    if start == end:
        return [
            time,
            f'<circle cx="{start}" cy="{y}" r="4" fill="{colour}"/>',
            f'<text x="{start + NOTE_GAP}" y="{y + 4}" fill="{colour}" {halo}>{escape(arrow.label)}</text>',
        ]
    back = -8 if end > start else 8
    middle = (start + end) // 2
    lines = _lines(arrow)
    first = y - 5 - LINE_HEIGHT * (len(lines) - 1)
    style = f'text-anchor="middle" fill="{colour}" {halo}'
    return [
        time,
        f'<line x1="{start}" y1="{y}" x2="{end}" y2="{y}" stroke="{colour}" stroke-width="1.5"{DASHES[arrow.kind]}/>',
        f'<path d="M{end} {y} l{back} -4 v8 z" fill="{colour}"/>',
        *(
            f'<text x="{middle}" y="{first + LINE_HEIGHT * row}" {style}>{escape(line)}</text>'
            for row, line in enumerate(lines)
        ),
    ]


def _in_words(arrows: Sequence[Arrow]) -> str:
    def sentence(arrow: Arrow) -> str:
        to = "" if arrow.sender == arrow.receiver else f" to {arrow.receiver}"
        return f"{arrow.time:.2f} s: {arrow.sender}{to}: {arrow.label}."

    return " ".join(sentence(arrow) for arrow in arrows)
