"""The numbered clauses of an exercise's statement, read from the task cell of its notebook."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from autograder.engine.notebook import text_of_cell

_CLAUSE = re.compile(r"^(\d+)\. +(.+(?:\n(?!\d+\. |\n).+)*)", re.MULTILINE)
_MARKUP = re.compile(r"[`*]")


@cache
def clauses_in(notebook: Path) -> Mapping[int, str]:
    """Return the clauses by number, each as one line of plain text; empty without a readable notebook."""
    return {
        int(number): " ".join(_MARKUP.sub("", text).split())
        for number, text in _CLAUSE.findall(text_of_cell(notebook, "task"))
    }


def in_words(clauses: Mapping[int, str], numbers: Sequence[int]) -> str:
    """Return some clauses to read: 'clause 4, “Every request is answered at once …”'."""
    known = [number for number in numbers if number in clauses]
    if len(known) > 1:
        return "clauses " + ", ".join(f"{number} (“{clauses[number]}”)" for number in known)
    return f"clause {known[0]}, “{clauses[known[0]]}”" if known else ""
