"""Reads the pictures that a notebook embeds."""

from __future__ import annotations

import base64
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from html import unescape

from IPython.display import HTML

TEXT = "{http://www.w3.org/2000/svg}text"


@dataclass(frozen=True)
class Drawing:
    """The alternative text of a picture, and the texts that it shows."""

    alt: str
    texts: list[str]


def read(html: HTML) -> Drawing:
    """Read the SVG in a figure; it must be well-formed."""
    found = re.search(r'data:image/svg\+xml;base64,([^"]+)" width="\d+" alt="([^"]*)"', html.data)
    assert found
    root = ET.fromstring(base64.b64decode(found[1]))
    return Drawing(unescape(found[2]), ["".join(element.itertext()).strip() for element in root.iter(TEXT)])
