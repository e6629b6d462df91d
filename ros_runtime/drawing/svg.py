"""The frame of every drawing: a title, a text alternative, and a white sheet, which is dark in a dark notebook."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable

_NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")  # XML 1.0, 2.2
CLASS = "course-drawing"
# The style of a drawing of this class in JupyterLab, whose theme is not the browser's.
_DARK = f'body[data-jp-theme-light="false"] .{CLASS} {{ filter: invert(0.91) hue-rotate(180deg); }}'
DARK_IN_JUPYTERLAB = f"<style>{_DARK}</style>"


def escape(text: str) -> str:
    """Return a text escaped for XML; a character that XML does not allow becomes U+FFFD."""
    return html.escape(_NO_XML.sub("\ufffd", text))


def shorten(text: str, most: int) -> str:
    """Return a text of at most `most` characters; "…" replaces what is left out."""
    return text if len(text) <= most else f"{text[: most - 1]}…"


def svg(parts: Iterable[str], *, width: int, height: int, title: str, words: str) -> str:
    """Return a drawing of `width` × `height` px with these SVG elements; `words` is the text alternative."""
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" role="img" '
            f'class="{CLASS}" font-family="sans-serif" font-size="13">',
            DARK_IN_JUPYTERLAB,
            f"<title>{escape(title)}</title>",
            f"<desc>{escape(words)}</desc>",
            f'<rect width="{width}" height="{height}" fill="white"/>',
            f'<text x="12" y="22" font-size="15" font-weight="bold">{escape(title)}</text>',
            *parts,
            "</svg>",
        ]
    )
