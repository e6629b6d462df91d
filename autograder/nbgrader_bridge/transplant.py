"""Puts what a student wrote into a copy of the release notebook: the only form in which nbgrader gets to see it.

A student's notebook can hold anything: metadata that ends a whole batch, cells twice or not at all, markdown that
formgrader would render as live HTML. None of it is copied. Only the text that was graded is, into one code cell.
"""

from __future__ import annotations

import copy

from nbformat import NotebookNode
from nbgrader.utils import is_solution

LONGEST_SOURCE = 60_000  # characters shown


class NoSolutionCell(Exception):
    """The release notebook has no cell to put a student's work into."""


def transplant(release: NotebookNode, exercise: str, source: str | None, problem: str = "") -> NotebookNode:
    """Return the release notebook with `source`, the content of `<exercise>.py`, in its solution cell.

    Without a source the cell says what the problem with the submission is.
    """
    magic = f"%%writefile {exercise}.py"
    notebook = copy.deepcopy(release)
    for cell in notebook.cells:
        if cell.cell_type == "code" and is_solution(cell) and cell.source.startswith(magic):
            cell.source = f"{magic}\n{_shown(source, problem)}"
            cell.outputs = []
            return notebook
    raise NoSolutionCell(f"the release notebook of {exercise} has no solution cell that begins {magic!r}")


def _shown(source: str | None, problem: str) -> str:
    if source is None:
        return f"# The submission could not be read: {' '.join(problem.split())}"
    if len(source) > LONGEST_SOURCE:
        return f"{source[:LONGEST_SOURCE]}\n# … the file goes on; all of it was graded"
    return source
