"""A bar chart as SVG: a bar for each label, with its number above it."""

from __future__ import annotations

from collections.abc import Mapping

from ros_runtime.drawing.svg import svg
from ros_runtime.drawing.xml_text import escape

BAR, GAP = 44, 8  # px, as all below
LEFT, TOP, HEIGHT, BOTTOM = 44, 56, 120, 44
FILL = "#1f5fa8"


def bars_svg(numbers: Mapping[str, int], *, title: str, across: str, up: str) -> str:
    """Draw the numbers by their labels, from left to right; `across` and `up` name the axes.

    Raises:
        ValueError: there is no label.
    """
    if not numbers:
        raise ValueError("a bar chart needs at least one label")
    most = max(1, *numbers.values())
    base = TOP + HEIGHT
    width = LEFT + len(numbers) * (BAR + GAP) + GAP
    parts = [
        f'<line x1="{LEFT}" y1="{base}" x2="{width - GAP}" y2="{base}" stroke="#777777"/>',
        f'<text x="{(LEFT + width) // 2}" y="{base + 36}" text-anchor="middle" fill="#555555">{escape(across)}</text>',
        f'<text transform="translate(22 {TOP + HEIGHT // 2}) rotate(-90)" text-anchor="middle" fill="#555555">'
        f"{escape(up)}</text>",
    ]
    for index, (label, number) in enumerate(numbers.items()):
        x = LEFT + GAP + index * (BAR + GAP)
        height = round(HEIGHT * number / most)
        middle = x + BAR // 2
        parts += [
            f'<rect x="{x}" y="{base - height}" width="{BAR}" height="{height}" fill="{FILL}"/>',
            f'<text x="{middle}" y="{base + 17}" text-anchor="middle" font-size="12">{escape(label)}</text>',
        ]
        if number:
            parts.append(f'<text x="{middle}" y="{base - height - 5}" text-anchor="middle">{number}</text>')
    words = ", ".join(f"{label}: {number}" for label, number in numbers.items() if number)
    return svg(
        parts, width=width, height=base + BOTTOM, title=title, words=f"{up} by {across}: {words or 'none'}."
    )
