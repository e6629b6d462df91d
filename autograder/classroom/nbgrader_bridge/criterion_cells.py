"""Generates the cells of an essay's notebook from its rubric.

The cells are a table at the beginning, for students, and at the end one cell per criterion, into which a person enters
points in formgrader.
"""

from __future__ import annotations

from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell

from autograder.authoring.rubric import Criterion
from autograder.classroom.nbgrader_bridge.check_cells import HEADING_ID, cell_metadata
from autograder.engine.essay import Essay
from autograder.engine.exercise import UnusableExercise

RUBRIC_ID = "rubric"
HEADING = """## The marks

One cell for each criterion of the rubric. A person fills them in, from what you wrote above."""


def with_criterion_cells(notebook: NotebookNode, essay: Essay) -> NotebookNode:
    """Return the notebook with the rubric in the cell `rubric`, and its last section replaced by the criteria's cells.

    Raises:
        UnusableExercise: there is no cell `rubric`.
    """
    kept: list[NotebookNode] = []
    for cell in notebook.cells:
        if cell.id == HEADING_ID:
            break
        kept.append(_rubric_cell(essay) if cell.id == RUBRIC_ID else cell)
    if not any(cell.id == RUBRIC_ID for cell in kept):
        raise UnusableExercise(
            f"the notebook of {essay.name} has no cell {RUBRIC_ID!r}, where students read the rubric"
        )
    return NotebookNode(notebook | {"cells": kept + criterion_cells(essay)})


def criterion_cells(essay: Essay) -> list[NotebookNode]:
    """Return a heading and a locked cell for each criterion, in order."""
    heading = new_markdown_cell(HEADING, id=HEADING_ID, metadata=cell_metadata(HEADING_ID))
    return [heading, *map(_criterion_cell, essay.criteria)]


def _criterion_cell(criterion: Criterion) -> NotebookNode:
    """A manually graded task of nbgrader: formgrader asks for its points, whatever the cell contains."""
    levels = "\n".join(f"- {level}" for level in _levels(criterion))
    source = f"### {criterion.title} ({criterion.points} points)\n\n{levels}"
    metadata = cell_metadata(criterion.id)
    metadata["nbgrader"] |= {"task": True, "points": criterion.points}
    return new_markdown_cell(source, id=criterion.id, metadata=metadata)


def _rubric_cell(essay: Essay) -> NotebookNode:
    total = sum(criterion.points for criterion in essay.criteria)
    rows = [f"| {criterion.title} | {'<br>'.join(_levels(criterion))} |" for criterion in essay.criteria]
    source = "\n".join(
        [
            "## How it is marked",
            "",
            f"A person reads what you write and gives at most {total} points, by this table and nothing else.",
            "",
            "| Looked at | Points |",
            "|---|---|",
            *rows,
        ]
    )
    return new_markdown_cell(source, id=RUBRIC_ID, metadata=cell_metadata(RUBRIC_ID))


def _levels(criterion: Criterion) -> list[str]:
    """The levels of a criterion with their points, from the most to the fewest."""
    return [f"**{points}**: {words}" for points, words in sorted(criterion.levels.items(), reverse=True)]
