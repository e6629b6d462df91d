"""Marks grade cells without a verdict for manual grading, instead of scoring them 0."""

from __future__ import annotations

from typing import Any

from nbformat import NotebookNode
from nbgrader.api import Gradebook
from nbgrader.preprocessors import NbGraderPreprocessor

from autograder.classroom.nbgrader_bridge.cell_points import UNJUDGED


class UnjudgedCells(NbGraderPreprocessor):
    """Removes the saved scores of checks that were not run: hidden ones where there is no isolation."""

    def preprocess(self, nb: NotebookNode, resources: Any) -> tuple[NotebookNode, Any]:
        """Mark the cells in the gradebook as needing manual grading."""
        names = resources["nbgrader"]
        with Gradebook(names["db_url"]) as gradebook:
            for cell in names[UNJUDGED]:
                grade = gradebook.find_grade(cell, names["notebook"], names["assignment"], names["student"])
                grade.auto_score = None
                grade.needs_manual_grade = True
            gradebook.db.commit()
        return nb, resources
