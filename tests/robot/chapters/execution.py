"""Executes each chapter once in a folder of its own, from top to bottom, as a student would."""

from __future__ import annotations

import re
from pathlib import Path

from autograder.classroom.book.chapter_run import Executed, processes_in
from autograder.classroom.book.chapter_run import execute as execute_file
from autograder.classroom.book.still_widgets import VIEW, models_of, still

__all__ = [
    "CHAPTERS",
    "Executed",
    "execute",
    "in_order",
    "number",
    "numbers",
    "on_paper",
    "processes_in",
    "words_of",
]

CHAPTERS = Path(__file__).resolve().parents[3] / "chapters"


def execute(name: str, folder: Path) -> Executed:
    """Run all cells of a chapter; a cell that raises fails the test with its traceback."""
    return execute_file(CHAPTERS / f"{name}.ipynb", folder)


def on_paper(chapter: Executed, cell_id: str) -> str:
    """The HTML of the widgets that a cell showed, as the book has it."""
    cell = next(cell for cell in chapter.notebook.cells if cell.id == cell_id)
    views = [output.data[VIEW] for output in cell.outputs if VIEW in output.get("data", {})]
    return "".join(still(view["model_id"], models_of(chapter.notebook)) for view in views)


def words_of(html: str) -> str:
    """The description of a picture, in words."""
    found = re.search(r'alt="([^"]+)"', html)
    assert found
    return found[1]


def in_order(text: str, *parts: str) -> bool:
    """Whether the parts occur in a text in this order."""
    return re.search(".*?".join(re.escape(part) for part in parts), text, re.DOTALL) is not None


def number(pattern: str, text: str) -> float:
    """The number that a pattern finds in a text; `#` in the pattern is any number."""
    found = re.search(pattern.replace("#", r"(-?[\d.]+)"), text)
    assert found, (pattern, text)
    return float(found[1])


def numbers(pattern: str, text: str) -> list[float]:
    """All the numbers that a pattern finds in a text."""
    return [float(found) for found in re.findall(pattern, text)]
