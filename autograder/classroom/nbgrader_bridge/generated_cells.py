"""The cells of a source notebook that are generated: one for each check, or for each criterion of an essay.

The cell of a visible check has the check's id as its name. The cell of a hidden check only has a number, because
students see the cell's name. An essay has a cell with a table of the rubric at the beginning, for students. At the end
it has one cell for each criterion, into which a person enters points in formgrader.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import takewhile
from typing import Any

from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell

from autograder.authoring.checks import Check
from autograder.authoring.rubric import Criterion
from autograder.engine.essay import Essay, load_essay
from autograder.engine.exercise import Exercise, UnusableExercise, essay_names, load_exercise
from autograder.engine.verdict import CheckVerdict

HEADING_ID, RUBRIC_ID = "verdicts", "rubric"
VERDICTS = """## The verdicts

These cells are for the grader, who runs them: you have nothing to do here, and they may stay empty. There is one for
each check. What is hidden is checked when your work is graded: the task above covers it."""
MARKS = """## The marks

One cell for each criterion of the rubric. A person fills them in, from what you wrote above."""
HIDDEN = "hidden_"  # the beginning of the names of hidden checks' cells
HIDDEN_HELP = "Not passed. Read the task again sentence by sentence: every sentence of it is checked."


def hidden_help(promise: str) -> str:
    """Return the student's text for a hidden check that did not pass; `promise`: the clause that the check judges."""
    return f"Not passed. It checks {promise}" if promise else HIDDEN_HELP


def cell_names(checks: Sequence[Check] | Sequence[CheckVerdict]) -> dict[str, str]:
    """Return the grade_id of each check's cell by the check's id."""
    hidden = [check.id for check in checks if check.hidden]
    numbered = {name: f"{HIDDEN}{number}" for number, name in enumerate(hidden, start=1)}
    return {check.id: numbered.get(check.id, check.id) for check in checks}


def with_generated_cells(notebook: NotebookNode, exercise: str) -> NotebookNode:
    """Return an exercise's notebook with up-to-date cells for its checks or its rubric.

    Raises:
        UnusableExercise: the notebook of an essay has no cell `rubric`.
    """
    if exercise in essay_names():
        return with_criterion_cells(notebook, load_essay(exercise))
    return _with_last_section(notebook, VERDICTS, check_cells(load_exercise(exercise, hidden=True)))


def check_cells(exercise: Exercise) -> list[NotebookNode]:
    """Return a locked grade cell for each check, in order."""
    names = cell_names(exercise.checks)
    return [_check_cell(check, names[check.id]) for check in exercise.checks]


def with_criterion_cells(notebook: NotebookNode, essay: Essay) -> NotebookNode:
    """Return the notebook with the rubric in the cell `rubric`, and with one cell per criterion as its last section.

    Raises:
        UnusableExercise: there is no cell `rubric`.
    """
    cells = [_rubric_cell(essay) if cell.id == RUBRIC_ID else cell for cell in notebook.cells]
    if RUBRIC_ID not in {cell.id for cell in cells}:
        raise UnusableExercise(
            f"the notebook of {essay.name} has no cell {RUBRIC_ID!r}, where students read the rubric"
        )
    notebook = NotebookNode(notebook | {"cells": cells})
    return _with_last_section(notebook, MARKS, list(map(_criterion_cell, essay.criteria)))


def _with_last_section(notebook: NotebookNode, heading: str, section: Sequence[NotebookNode]) -> NotebookNode:
    """Return the notebook with these cells as its last section, in place of the section generated earlier."""
    before = list(takewhile(lambda cell: cell.id != HEADING_ID, notebook.cells))
    begin = new_markdown_cell(heading, id=HEADING_ID, metadata=cell_metadata(HEADING_ID))
    return NotebookNode(notebook | {"cells": [*before, begin, *section]})


def cell_metadata(name: str, *, points: int | None = None, solution: bool = False) -> dict[str, Any]:
    """Return nbgrader's metadata for a cell: a locked cell with or without points, or a solution cell."""
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


def _check_cell(check: Check, name: str) -> NotebookNode:
    points = f"{check.points} point{'s' if check.points != 1 else ''}"
    if check.hidden:
        number = name.removeprefix(HIDDEN)
        source = f"# Hidden check {number} ({points})\nchecked.hidden({number})"
    else:
        source = f'# {check.title} ({points})\nchecked.show("{check.id}")'
    return new_code_cell(source, id=name, metadata=cell_metadata(name, points=check.points))


def _criterion_cell(criterion: Criterion) -> NotebookNode:
    """Return a cell that nbgrader calls a manually graded task: a person enters its points in formgrader."""
    levels = "\n".join(f"- {level}" for level in _levels(criterion))
    source = f"### {criterion.title} ({criterion.points} points)\n\n{levels}"
    metadata = cell_metadata(criterion.id)
    metadata["nbgrader"] |= {"task": True, "points": criterion.points}
    return new_markdown_cell(source, id=criterion.id, metadata=metadata)


def _rubric_cell(essay: Essay) -> NotebookNode:
    total = sum(criterion.points for criterion in essay.criteria)
    rows = [f"| {criterion.title} | {'<br>'.join(_levels(criterion))} |" for criterion in essay.criteria]
    lines = [
        "## How it is marked\n",
        f"A person reads what you write and gives at most {total} points, by this table and nothing else.\n",
        "| Looked at | Points |",
        "|---|---|",
        *rows,
    ]
    return new_markdown_cell("\n".join(lines), id=RUBRIC_ID, metadata=cell_metadata(RUBRIC_ID))


def _levels(criterion: Criterion) -> list[str]:
    """Return the levels of a criterion with their points, in descending order of points."""
    return [f"**{points}**: {words}" for points, words in sorted(criterion.levels.items(), reverse=True)]
