"""nbgrader preprocessors that write verdicts into a submission's notebook; stock nbgrader would execute it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from nbformat import NotebookNode
from nbformat.v4 import new_output
from nbgrader.api import Gradebook
from nbgrader.preprocessors import NbGraderPreprocessor
from nbgrader.utils import is_grade, is_solution
from traitlets import Unicode

from autograder.classroom.nbgrader_bridge.generated_cells import cell_names, hidden_help
from autograder.engine.essay import load_essay
from autograder.engine.exercise import essay_names, file_names
from autograder.engine.notebook import written_by
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.table import verdict_text

UNJUDGED_KEY = "unjudged_cells"  # in resources["nbgrader"]: the grade_ids that have no verdict
# The student reads this on the feedback page, from which nbgrader removes every drawing.
DRAWING_REPLACEMENT = "Your marker saw a drawing of this."


class NotGradedError(Exception):
    """There is no grade to enter, through no fault of the student; nbgrader must not record a score."""


class VerdictOutputs(NbGraderPreprocessor):
    """Writes two outputs into every grade cell: the points as a number, and the verdict as text on stdout.

    nbgrader scores an error or output on stderr as 0, and a cell without a number as full marks. Therefore every cell
    gets a number, and a submission without a grade raises `NotGradedError`.
    """

    records = Unicode(help="folder with one JSON file for each student: a list of grades").tag(config=True)

    def preprocess(self, nb: NotebookNode, resources: Any) -> tuple[NotebookNode, Any]:
        """Write the outputs of one student's notebook; raises `NotGradedError`."""
        names = resources["nbgrader"]
        grade = read_grade(Path(self.records), names["student"], names["assignment"])
        verdicts = verdicts_by_cell(grade)
        names[UNJUDGED_KEY] = []
        for count, cell in enumerate((cell for cell in nb.cells if cell.cell_type == "code"), start=1):
            if not is_grade(cell) or is_solution(cell):
                continue
            cell.execution_count = count
            verdict = verdicts.get(cell.metadata.nbgrader.grade_id)
            if verdict is None:
                names[UNJUDGED_KEY].append(cell.metadata.nbgrader.grade_id)
            cell.outputs = outputs(verdict, float(cell.metadata.nbgrader.points), count)
        return nb, resources


def read_grade(records: Path, student: str, exercise: str) -> Grade:
    """Return the recorded grade of a submission; raises `NotGradedError` if there is none."""
    path = records / f"{student}.json"
    try:
        grades = [Grade.from_json(record) for record in json.loads(path.read_text())]
    except FileNotFoundError:
        raise NotGradedError(f"there is no {path}; grade with `course grade` first") from None
    grade = next((grade for grade in grades if grade.exercise == exercise), None)
    if grade is None:
        raise NotGradedError(f"{path} has no grade for {exercise}; grade with `course grade` first")
    if grade.status == "not graded":
        raise NotGradedError(
            f"{student}'s {exercise} was not graded: {grade.why_not_graded or 'see ' + str(path)}"
        )
    return grade


def verdicts_by_cell(grade: Grade) -> dict[str, CheckVerdict]:
    """Return the verdicts by the grade_id of their cells."""
    names = cell_names(grade.checks)
    return {names[verdict.id]: verdict for verdict in grade.checks}


def outputs(verdict: CheckVerdict | None, max_points: float, count: int) -> list[NotebookNode]:
    """Return two outputs: the text of the verdict, and the points, between 0 and `max_points`."""
    points = min(max(float(verdict.points), 0.0), max_points) if verdict else 0.0
    return [
        new_output("stream", name="stdout", text=_text(verdict) + "\n"),
        new_output("execute_result", data={"text/plain": str(points)}, execution_count=count),
    ]


def _text(verdict: CheckVerdict | None) -> str:
    """Return the text for the student; for a hidden check, only whether it passed, so that its inputs stay secret."""
    if verdict is None:
        return "Not checked automatically."
    if verdict.hidden:
        return "Passed." if verdict.status == "passed" else hidden_help(verdict.promise)
    return verdict_text(verdict)


class EssayPictures(NbGraderPreprocessor):
    """Shows an essay's picture below the cell that writes the essay's first file. No student's code is executed."""

    def preprocess(self, nb: NotebookNode, resources: Any) -> tuple[NotebookNode, Any]:
        """Insert the picture if the exercise is an essay with a picture."""
        name = resources["nbgrader"]["assignment"]
        if name not in essay_names() or (picture := load_essay(name).picture) is None:
            return nb, resources
        solutions = [cell for cell in nb.cells if cell.cell_type == "code" and is_solution(cell)]
        written = [(cell, written_by([cell.source]).files) for cell in solutions]
        cells = {file: cell for file in file_names(name) for cell, files in written if file in files}
        svg = picture({file: text for _, files in written for file, text in files.items() if file in cells})
        if svg and cells:
            first = next(iter(cells.values()))
            first.outputs = [
                new_output("display_data", data={"image/svg+xml": svg, "text/plain": DRAWING_REPLACEMENT})
            ]
        return nb, resources


class UnjudgedCells(NbGraderPreprocessor):
    """Removes nbgrader's scores of checks that were not run, such as hidden checks without isolation."""

    def preprocess(self, nb: NotebookNode, resources: Any) -> tuple[NotebookNode, Any]:
        """Mark the cells in the gradebook as needing manual grading."""
        names = resources["nbgrader"]
        with Gradebook(names["db_url"]) as gradebook:
            for cell in names[UNJUDGED_KEY]:
                grade = gradebook.find_grade(cell, names["notebook"], names["assignment"], names["student"])
                grade.auto_score = None
                grade.needs_manual_grade = True
            gradebook.db.commit()
        return nb, resources
