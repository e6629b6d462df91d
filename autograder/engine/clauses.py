"""The numbered clauses of an exercise's statement, read from the task cell of its notebook."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from autograder.engine.notebook import cells_in, source_of

_CLAUSE = re.compile(r"^(\d+)\. +(.+(?:\n(?!\d+\. |\n).+)*)", re.MULTILINE)
_MARKUP = re.compile(r"[`*]")


@cache
def clauses_in(notebook: Path) -> Mapping[int, str]:
    """Return the clauses by number, each as one line of plain text; empty without a readable notebook."""
    try:
        cells = cells_in(notebook.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError):
        return {}
    task = next((cell for cell in cells if cell.get("id") == "task"), {})
    return {
        int(number): " ".join(_MARKUP.sub("", text).split())
        for number, text in _CLAUSE.findall(source_of(task))
    }


def in_words(clauses: Mapping[int, str], numbers: Sequence[int]) -> str:
    """Return some clauses to read: 'clause 4, “Every request is answered at once …”'."""
    known = [number for number in numbers if number in clauses]
    if len(known) > 1:
        return "clauses " + ", ".join(f"{number} (“{clauses[number]}”)" for number in known)
    return f"clause {known[0]}, “{clauses[known[0]]}”" if known else ""
