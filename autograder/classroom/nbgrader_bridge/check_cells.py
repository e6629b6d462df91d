"""Generates the locked grade cells at the end of an exercise's notebook from its checks."""

from __future__ import annotations

from typing import Any

from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell

from autograder.authoring.checks import Check
from autograder.classroom.nbgrader_bridge.cell_names import cell_names
from autograder.engine.exercise import Exercise

HEADING_ID = "verdicts"
HEADING = """## The verdicts

One cell for each check, filled from the last self-check. What is hidden is checked when your work is graded: the task
above covers it."""


def with_check_cells(notebook: NotebookNode, exercise: Exercise) -> NotebookNode:
    """Return the notebook with its last section, the verdicts, replaced by the cells of the exercise's checks."""
    kept: list[NotebookNode] = []
    for cell in notebook.cells:
        if cell.id == HEADING_ID:
            break
        kept.append(cell)
    return NotebookNode(notebook | {"cells": kept + check_cells(exercise)})


def check_cells(exercise: Exercise) -> list[NotebookNode]:
    """Return a heading and one locked grade cell for each check, in order."""
    heading = new_markdown_cell(HEADING, id=HEADING_ID, metadata=cell_metadata("verdicts"))
    names = cell_names(exercise.checks)
    return [heading, *(_check_cell(check, names[check.id]) for check in exercise.checks)]


def _check_cell(check: Check, name: str) -> NotebookNode:
    points = f"{check.points} point{'s' if check.points != 1 else ''}"
    if check.hidden:
        number = name.removeprefix("hidden_")
        source = f"# Hidden check {number} ({points})\nchecked.hidden({number})"
    else:
        source = f'# {check.title} ({points})\nchecked.show("{check.id}")'
    return new_code_cell(source, id=name, metadata=cell_metadata(name, points=check.points))


def cell_metadata(name: str, *, points: int | None = None, solution: bool = False) -> dict[str, Any]:
    """Return nbgrader's metadata of a cell: locked, with or without points, or the place of a solution."""
    nbgrader: dict[str, Any] = {
        "grade": points is not None,
        "grade_id": name,
        "locked": not solution,
        "schema_version": 3,
        "solution": solution,
        "task": False,
    }
    if points is not None:
        nbgrader["points"] = points
    return {"nbgrader": nbgrader}
