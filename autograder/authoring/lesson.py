"""The lesson that a failure refers to: CHAPTER#cell, as in docs/coverage.md, or a URL."""

from __future__ import annotations

import json
from functools import cache

from ros_runtime.project import COURSE

CHAPTERS = COURSE / "chapters"


def in_words(see: str) -> str:
    """Return where to read: the chapter's file and the heading above the cell.

    >>> in_words("02_services#m9-why")
    'chapters/02_services.ipynb, “Break it: ask before there is an answer”'
    """
    chapter, _, cell = see.partition("#")
    if "://" in see:
        return see
    heading = _headings(chapter).get(cell)
    return f"chapters/{chapter}.ipynb" + (f", “{heading}”" if heading else "")


def address(see: str) -> str:
    """Return the address of the lesson, as a link in an exercise's notebook."""
    chapter, _, cell = see.partition("#")
    heading = _headings(chapter).get(cell, "").replace(" ", "-")
    return see if "://" in see else f"../../chapters/{chapter}.ipynb" + (f"#{heading}" if heading else "")


def is_there(see: str) -> bool:
    """Return whether the cell exists; a URL is not checked."""
    chapter, _, cell = see.partition("#")
    return "://" in see or cell in _headings(chapter)


@cache
def _headings(chapter: str) -> dict[str, str]:
    """Return the heading above each cell of a chapter; {} if there is no such chapter."""
    path = CHAPTERS / f"{chapter}.ipynb"
    if not path.exists():
        return {}
    headings, latest = {}, ""
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "markdown":
            titles = [line for line in "".join(cell["source"]).splitlines() if line.startswith("#")]
            latest = titles[-1].lstrip("# ") if titles else latest
        headings[cell["id"]] = latest
    return headings
