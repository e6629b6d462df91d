"""The cells of a source notebook that are generated: one for each check, or for each criterion of an essay."""

from __future__ import annotations

from nbformat import NotebookNode

from autograder.classroom.nbgrader_bridge.check_cells import with_check_cells
from autograder.classroom.nbgrader_bridge.criterion_cells import with_criterion_cells
from autograder.engine.essay import load_essay
from autograder.engine.exercise import essay_names, load_exercise


def with_generated_cells(notebook: NotebookNode, exercise: str) -> NotebookNode:
    """Return an exercise's notebook with the cells that its checks or its rubric generate, as they are now."""
    if exercise in essay_names():
        return with_criterion_cells(notebook, load_essay(exercise))
    return with_check_cells(notebook, load_exercise(exercise, hidden=True))
