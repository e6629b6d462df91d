"""Reads an author's notebook of any format version as nbformat 4.5."""

from __future__ import annotations

import warnings
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from autograder.engine.exercise import UnusableExercise


def read_source(path: Path) -> NotebookNode:
    """Read a notebook in any version of the format; a cell without a unique id gets one, the same at every reading.

    Raises:
        UnusableExercise: the file is not a notebook.
    """
    try:
        with warnings.catch_warnings():  # nbformat warns about faults that are repaired below
            warnings.simplefilter("ignore")
            as_written = nbformat.reader.reads(path.read_text(encoding="utf-8-sig"))
            has_ids = nbformat.reader.get_version(as_written) >= (4, 5)
            notebook = nbformat.convert(as_written, 4)
        cells = notebook.cells
    except Exception as error:  # a broken file fails in many ways: invalid JSON, no cells, malformed cells
        raise UnusableExercise(f"{path} is not a notebook: {error}") from error
    seen: set[str] = set()
    for number, cell in enumerate(cells, 1):
        if not has_ids or cell.get("id", "") in {"", *seen}:
            named = cell.metadata.get("nbgrader", {}).get("grade_id")
            cell.id = named if named and named not in seen else f"cell-{number}"
        seen.add(cell.id)
    notebook.nbformat, notebook.nbformat_minor = 4, 5
    return notebook
