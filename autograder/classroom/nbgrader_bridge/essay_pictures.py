"""The preprocessor that draws an essay for its marker, as the rubric's `picture` does."""

from __future__ import annotations

from typing import Any

from nbformat import NotebookNode
from nbformat.v4 import new_output
from nbgrader.preprocessors import NbGraderPreprocessor
from nbgrader.utils import is_solution

from autograder.engine.essay import load_essay
from autograder.engine.exercise import essay_names, file_names
from autograder.engine.notebook import written_by

ON_PAPER = "Your marker saw this drawn."  # for the feedback page, from which nbgrader takes every drawing


class EssayPictures(NbGraderPreprocessor):
    """Puts the picture below the cell that writes an essay's first file. Nothing a student wrote is executed."""

    def preprocess(self, nb: NotebookNode, resources: Any) -> tuple[NotebookNode, Any]:
        """Draw, where the exercise is an essay with a picture."""
        name = resources["nbgrader"]["assignment"]
        if name not in essay_names() or (picture := load_essay(name).picture) is None:
            return nb, resources
        solutions = [cell for cell in nb.cells if cell.cell_type == "code" and is_solution(cell)]
        written = [(cell, written_by([cell.source]).files) for cell in solutions]
        cells = {file: cell for file in file_names(name) for cell, files in written if file in files}
        svg = picture({file: text for _, files in written for file, text in files.items() if file in cells})
        if svg and cells:
            first = next(iter(cells.values()))
            first.outputs = [new_output("display_data", data={"image/svg+xml": svg, "text/plain": ON_PAPER})]
        return nb, resources
