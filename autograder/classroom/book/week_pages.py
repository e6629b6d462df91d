"""One page per chapter to project or print: the chapter's title, outcomes, drawing and conventions."""

from __future__ import annotations

import re

from nbformat import NotebookNode

_DRAWING = re.compile(r"^!\[.*\]\(images/", re.MULTILINE)


def week_page(notebook: NotebookNode) -> str | None:
    """Return a chapter's page as Markdown, with links relative to the chapter, or None if it has no drawing."""
    texts = {cell.id: cell.source for cell in notebook.cells if cell.cell_type == "markdown"}
    drawn = [text for text in (texts.get("diagram", ""), *texts.values()) if _DRAWING.search(text)]
    if not drawn:
        return None
    title, *paragraphs = texts["title"].split("\n\n")
    outcomes = (text for text in paragraphs if text.startswith(("**After", "- ")))
    drawing = next(line for line in drawn[0].splitlines() if _DRAWING.match(line))
    _, _, conventions = texts.get("conventions", "").partition("\n\n")
    table = conventions.split("\n\n")[0]
    return "\n\n".join(part for part in (title, *outcomes, drawing, table) if part) + "\n"
