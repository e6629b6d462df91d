"""Rewrites a page's links for the book: links to pages and cells stay links, other local links become plain text."""

from __future__ import annotations

import os
import re
from collections.abc import Collection
from pathlib import PurePosixPath

CELL = "cell-id="  # JupyterLab's fragment for a cell
_FENCED = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"(?<!!)\[(?P<words>(?:[^\[\]]|\[[^\[\]]*\])+)\]\((?P<target>[^()\s]+)\)")


class Links:
    """The links of one page; the paths of this page and of all pages are relative to the project."""

    def __init__(self, page: PurePosixPath, pages: Collection[PurePosixPath]) -> None:
        self._page = page
        self._pages = pages

    def rewritten(self, text: str) -> str:
        """Return Markdown with rewritten links; fenced code stays unchanged."""
        parts = _FENCED.split(text)
        parts[::2] = [_LINK.sub(self._fitting, part) for part in parts[::2]]
        return "".join(parts)

    def _fitting(self, link: re.Match[str]) -> str:
        path, _, fragment = link["target"].partition("#")
        if "://" in path or not path:
            return link[0]
        page = PurePosixPath(os.path.normpath(self._page.parent / path))
        if page not in self._pages:
            return link["words"]
        if fragment.startswith(CELL):
            address = f"{PurePosixPath(path).with_suffix('.html')}#{fragment.removeprefix(CELL)}"
            return f'<a class="reference internal" href="{address}">{link["words"]}</a>'
        return link[0]
