"""Finds the gaps in a chapter, for tests of their form and tests that fill them."""

from __future__ import annotations

from itertools import pairwise

import nbformat

from lab.learning.gap_cells import MAGIC, solution


def gaps_of(notebook: nbformat.NotebookNode) -> dict[str, tuple[str, str]]:
    """Return the program and the solution of each gap, by the gap's file."""
    return {
        cell.source.splitlines()[0].removeprefix(MAGIC): (
            cell.source.partition("\n")[2] + "\n",
            solution(below.source),
        )
        for cell, below in pairwise(notebook.cells)
        if cell.source.startswith(MAGIC)
    }
