"""Escapes and shortens the texts of a drawing.

Students write some of these texts, and XML allows neither control characters nor lone surrogates.
"""

from __future__ import annotations

import html
import re

_NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")  # XML 1.0, 2.2


def escape(text: str) -> str:
    """Return a text escaped for XML; a character that XML does not allow becomes U+FFFD."""
    return html.escape(_NO_XML.sub("\ufffd", text))


def shorten(text: str, most: int) -> str:
    """Return a text of at most `most` characters; "…" replaces what is left out."""
    return text if len(text) <= most else f"{text[: most - 1]}…"
