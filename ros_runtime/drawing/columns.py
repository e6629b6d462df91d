"""An SVG drawing in three columns: nodes on the left and on the right, and between them one connection in each row."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ros_runtime.drawing.svg import escape, svg

NODE_WIDTH, MIDDLE_WIDTH, GAP = 180, 420, 80  # px, as all below
ROW_HEIGHT, BOX_HEIGHT = 34, 26
TOP, MARGIN = 64, 12
MIDDLE_X = MARGIN + NODE_WIDTH + GAP
RIGHT_X = MIDDLE_X + MIDDLE_WIDTH + GAP
WIDTH = RIGHT_X + NODE_WIDTH + MARGIN
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
    heights = [TOP + index * ROW_HEIGHT for index in range(len(rows))]
    left = _places([(end.node, y) for row, y in zip(rows, heights, strict=True) for end in row.left])
    right = _places([(end.node, y) for row, y in zip(rows, heights, strict=True) for end in row.right])
    parts = [
        f'<text x="{x + 8}" y="{TOP - 12}" fill="#555555">{escape(heading)}</text>'
        for x, heading in zip((MARGIN, MIDDLE_X, RIGHT_X), headings, strict=True)
    ]
    for row, y in zip(rows, heights, strict=True):
        parts += [_line(MARGIN + NODE_WIDTH, left[end.node], MIDDLE_X, y, end.broken) for end in row.left]
        parts += [
            _line(MIDDLE_X + MIDDLE_WIDTH, y, RIGHT_X, right[end.node], end.broken) for end in row.right
        ]
    parts += [_node_box(MARGIN, y, node) for node, y in left.items()]
    parts += [_middle_box(y, row) for row, y in zip(rows, heights, strict=True)]
    parts += [_node_box(RIGHT_X, y, node) for node, y in right.items()]
    height = max([*heights, *left.values(), *right.values()]) + ROW_HEIGHT + MARGIN
    if any(end.broken for row in rows for end in (*row.left, *row.right)):
        parts.append(_line(MARGIN, height, MARGIN + GAP, height, broken=True))
        parts.append(f'<text x="{MARGIN + GAP + 8}" y="{height + 17}">{escape(broken_means)}</text>')
        height += ROW_HEIGHT
    return svg(parts, width=WIDTH, height=height, title=title, words=words)


def _places(links: Sequence[tuple[str, int]]) -> dict[str, int]:
    """The y of each node, px: at the mean of its rows, and below the previous node."""
    beside: dict[str, list[int]] = {}
    for node, y in links:
        beside.setdefault(node, []).append(y)
    places: dict[str, int] = {}
    lowest = TOP
    for node, ys in sorted(beside.items(), key=lambda item: sum(item[1]) / len(item[1])):
        places[node] = max(lowest, sum(ys) // len(ys))
        lowest = places[node] + ROW_HEIGHT
    return places


def _line(x1: int, y1: int, x2: int, y2: int, broken: bool) -> str:
    middle = BOX_HEIGHT // 2
    return (
        f'<line x1="{x1}" y1="{y1 + middle}" x2="{x2}" y2="{y2 + middle}" stroke-width="1.5" '
        f"{BROKEN_LINE if broken else SOLID_LINE}/>"
    )


def _node_box(x: int, y: int, node: str) -> str:
    return _box(x, y, NODE_WIDTH, 'rx="13" fill="#eef3f9" stroke="#8aa4c0"') + (
        f'<text x="{x + NODE_WIDTH // 2}" y="{y + 17}" text-anchor="middle">{escape(node)}</text>'
    )


def _middle_box(y: int, row: Row) -> str:
    return _box(MIDDLE_X, y, MIDDLE_WIDTH, f'fill="{row.fill}" stroke="#c9b87a"') + (
        f'<text x="{MIDDLE_X + 8}" y="{y + 17}" fill="#1f5fa8" font-weight="bold">{escape(row.name)}</text>'
        f'<text x="{MIDDLE_X + MIDDLE_WIDTH - 8}" y="{y + 17}" text-anchor="end" font-size="11" fill="#555555">'
        f"{escape(row.detail)}</text>"
    )


def _box(x: int, y: int, width: int, look: str) -> str:
    return f'<rect x="{x}" y="{y}" width="{width}" height="{BOX_HEIGHT}" {look}/>'
