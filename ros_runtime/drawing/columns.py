"""An SVG drawing in three columns: nodes on the left and on the right, and between them one connection in each row."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ros_runtime.drawing.svg import escape, svg

GAP = 40  # px between two columns, as all below
ROW_HEIGHT, BOX_HEIGHT = 48, 40  # of a connection, its name above its detail
NODE_SPACING, NODE_HEIGHT = 34, 26
TOP, MARGIN, PADDING = 84, 4, 8  # TOP is the middle of the first row
LETTER_WIDTH, SMALL_LETTER_WIDTH = 7.5, 6.2  # of a wide font, on average
SOLID_LINE, BROKEN_LINE = 'stroke="#333333"', 'stroke="#c0392b" stroke-dasharray="5 4"'
SAND = "#fdf6e3"


@dataclass(frozen=True)
class End:
    """A node at one end of a row; the line to it is dashed and red when it is broken."""

    node: str
    broken: bool = False


@dataclass(frozen=True)
class Row:
    """One connection: its name, a detail such as its type, the nodes on both sides, and the colour of its box."""

    name: str
    detail: str
    left: Sequence[End]
    right: Sequence[End]
    fill: str = SAND


def columns_svg(
    rows: Sequence[Row], *, headings: tuple[str, str, str], title: str, words: str, broken_means: str
) -> str:
    """Draw the rows from top to bottom, each node once on each side; `words` is the text alternative.

    `broken_means` is the legend of the broken lines, if there are any.
    """
    middles = [TOP + index * ROW_HEIGHT for index in range(len(rows))]
    left = _places([(end.node, y) for row, y in zip(rows, middles, strict=True) for end in row.left])
    right = _places([(end.node, y) for row, y in zip(rows, middles, strict=True) for end in row.right])
    names, details = [row.name for row in rows], [row.detail for row in rows]
    widths = (
        _width([headings[0], *left]),
        _width([headings[1], *names], details),
        _width([headings[2], *right]),
    )
    left_x, middle_x, right_x = (MARGIN + sum(widths[:column]) + column * GAP for column in range(3))
    parts = [
        f'<text x="{x + PADDING}" y="52" fill="#555555">{escape(heading)}</text>'
        for x, heading in zip((left_x, middle_x, right_x), headings, strict=True)
    ]
    for row, y in zip(rows, middles, strict=True):
        parts += [_line(left_x + widths[0], left[end.node], middle_x, y, end.broken) for end in row.left]
        parts += [_line(middle_x + widths[1], y, right_x, right[end.node], end.broken) for end in row.right]
    parts += [_node_box(left_x, y, widths[0], node) for node, y in left.items()]
    parts += [_middle_box(middle_x, y, widths[1], row) for row, y in zip(rows, middles, strict=True)]
    parts += [_node_box(right_x, y, widths[2], node) for node, y in right.items()]
    height = max([*middles, *left.values(), *right.values()]) + ROW_HEIGHT
    if any(end.broken for row in rows for end in (*row.left, *row.right)):
        parts.append(_line(MARGIN, height, MARGIN + 2 * GAP, height, broken=True))
        parts.append(f'<text x="{MARGIN + 2 * GAP + PADDING}" y="{height + 4}">{escape(broken_means)}</text>')
        height += NODE_SPACING
    return svg(parts, width=right_x + widths[2] + MARGIN, height=height, title=title, words=words)


def _width(texts: Iterable[str], small: Iterable[str] = ()) -> int:
    """Return the width (px) of boxes for these texts."""
    letters = [
        *(LETTER_WIDTH * len(text) for text in texts),
        *(SMALL_LETTER_WIDTH * len(text) for text in small),
    ]
    return round(max(letters)) + 2 * PADDING


def _places(links: Sequence[tuple[str, int]]) -> dict[str, int]:
    """The middle of each node, px: at the mean of its rows, and below the previous node."""
    beside: dict[str, list[int]] = {}
    for node, y in links:
        beside.setdefault(node, []).append(y)
    places: dict[str, int] = {}
    lowest = TOP
    for node, ys in sorted(beside.items(), key=lambda item: sum(item[1]) / len(item[1])):
        places[node] = max(lowest, sum(ys) // len(ys))
        lowest = places[node] + NODE_SPACING
    return places


def _line(x1: int, y1: int, x2: int, y2: int, broken: bool) -> str:
    look = BROKEN_LINE if broken else SOLID_LINE
    return f'<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" stroke-width="1.5" {look}/>'


def _node_box(x: int, y: int, width: int, node: str) -> str:
    return _box(x, y, width, NODE_HEIGHT, 'rx="13" fill="#eef3f9" stroke="#8aa4c0"') + (
        f'<text x="{x + width // 2}" y="{y + 4}" text-anchor="middle">{escape(node)}</text>'
    )


def _middle_box(x: int, y: int, width: int, row: Row) -> str:
    return _box(x, y, width, BOX_HEIGHT, f'fill="{row.fill}" stroke="#c9b87a"') + (
        f'<text x="{x + PADDING}" y="{y - 4}" fill="#1f5fa8" font-weight="bold">{escape(row.name)}</text>'
        f'<text x="{x + PADDING}" y="{y + 12}" font-size="11" fill="#555555">{escape(row.detail)}</text>'
    )


def _box(x: int, y: int, width: int, height: int, look: str) -> str:
    return f'<rect x="{x}" y="{y - height // 2}" width="{width}" height="{height}" {look}/>'
