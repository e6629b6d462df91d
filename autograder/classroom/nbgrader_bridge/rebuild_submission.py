"""Rebuilds a submission for nbgrader: a copy of the release notebook with the student's code in its solution cells.

A student's notebook can contain anything: metadata that aborts a whole batch, duplicate or missing cells, markdown that
formgrader would render as live HTML. Only the graded code is copied, one cell per file.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence

from nbformat import NotebookNode
from nbgrader.utils import is_solution

MAX_SOURCE_LENGTH = 60_000  # characters shown


class NoSolutionCell(Exception):
    """The release notebook has no cell for the student's code."""


def rebuild_submission(
    release: NotebookNode, names: Sequence[str], sources: Mapping[str, str] | None, problem: str = ""
) -> NotebookNode:
    """Return a copy of the release notebook with the sources of the files `names` in its solution cells.

    If `sources` is None, the cells quote `problem`, the reason why the submission could not be read.
    """
    notebook = copy.deepcopy(release)
    for name in names:
        cell = _solution_cell(notebook, name)
        cell.source = f"%%writefile {name}\n{_shown(sources, name, problem)}"
        cell.outputs = []
    return notebook


def _solution_cell(notebook: NotebookNode, name: str) -> NotebookNode:
    magic = f"%%writefile {name}"
    for cell in notebook.cells:
        if cell.cell_type == "code" and is_solution(cell) and cell.source.startswith(magic):
            return cell
    raise NoSolutionCell(f"the release notebook has no solution cell that begins {magic!r}")


def _shown(sources: Mapping[str, str] | None, name: str, problem: str) -> str:
    if sources is None:
        return f"# The submission could not be read: {' '.join(problem.split())}"
    if name not in sources:
        return "# This file was not handed in."
    source = sources[name]
    if len(source) > MAX_SOURCE_LENGTH:
        return f"{source[:MAX_SOURCE_LENGTH]}\n# … only the beginning is shown; the whole file was graded"
    return source
