"""The frame of every drawing: a title, a text alternative, and a white background, which also suits a dark page."""

from __future__ import annotations

from collections.abc import Iterable

from ros_runtime.drawing.xml_text import escape


def svg(parts: Iterable[str], *, width: int, height: int, title: str, words: str) -> str:
    """Return a drawing of `width` × `height` px with these SVG elements; `words` is the text alternative."""
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" role="img" '
            'font-family="sans-serif" font-size="13">',
            f"<title>{escape(title)}</title>",
            f"<desc>{escape(words)}</desc>",
            f'<rect width="{width}" height="{height}" fill="white"/>',
            f'<text x="12" y="22" font-size="15" font-weight="bold">{escape(title)}</text>',
            *parts,
            "</svg>",
        ]
    )
