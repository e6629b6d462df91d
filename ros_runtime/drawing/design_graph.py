"""A design as SVG: on the left the node that publishes or sends requests, then the link, then the receiving node."""

from __future__ import annotations

from ros_runtime.design import Design, Link
from ros_runtime.drawing.columns import SAND, End, Row, columns_svg
from ros_runtime.drawing.svg import shorten

HEADINGS = ("publishes or asks", "pattern, type", "receives or answers")
FILLS = {"topic": SAND, "service": "#e8f4ea", "action": "#e6eefb", "wire": "#eeeeee"}
LONGEST_NODE, LONGEST_TYPE = 24, 56  # characters that fit into a box
MOST_LINKS = 60  # links that are drawn, so that the drawing stays readable


def design_svg(design: Design, *, title: str) -> str:
    """Draw the links of a design; a link that lacks a fact has red, dashed lines.

    Raises:
        ValueError: there is no link to draw.
    """
    if not design.links:
        raise ValueError("a design needs at least one link")
    rows = [_row(link) for link in design.links[:MOST_LINKS]]
    words = " ".join(f"{link}: {link.pattern} {link.type}." for link in design.links[:MOST_LINKS])
    return columns_svg(rows, headings=HEADINGS, title=title, words=words, broken_means="lacks a fact")


def _row(link: Link) -> Row:
    broken = bool(link.missing())
    return Row(
        shorten(link.pattern, LONGEST_NODE),
        shorten(link.type, LONGEST_TYPE),
        left=[End(shorten(link.sender, LONGEST_NODE), broken)],
        right=[End(shorten(link.receiver, LONGEST_NODE), broken)],
        fill=FILLS.get(link.pattern, SAND),
    )
