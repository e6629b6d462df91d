"""The questions as an assignment of nbgrader, for which a person gives the points in formgrader.

Every student's notebook has the same cells `question_1`, `question_2` … for the answers, below the student's own
questions. Only the notebooks in the gradebook's folder have keys, and nbgrader's feedback pages leave them out.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell, new_notebook

from autograder.atomic_file import write_atomically
from autograder.classroom.batch.folder_lock import locked
from autograder.classroom.export.published import printable
from autograder.classroom.nbgrader_bridge.feedback_page import KEY
from autograder.classroom.nbgrader_bridge.generated_cells import cell_metadata
from autograder.classroom.nbgrader_bridge.gradebook import CourseGradebook, Entry
from autograder.classroom.questions.question import Sheet, html_of
from autograder.engine.essay import BY_HAND
from autograder.engine.exercise import exercises_folder
from autograder.engine.hand_in import OwnFile
from autograder.engine.notebook import cells_in, source_of
from autograder.engine.submission import UnusableSubmission, most_bytes
from autograder.engine.verdict import CheckVerdict, Grade

POINTS = 2  # for each question
LONGEST_ANSWER = 20_000  # characters that are shown
TO_ANSWER = "YOUR ANSWER HERE"  # nbgrader's words in a cell for an answer
NO_QUESTION = "No further question about this program has a sure key. Ask one of your own."
_PYTHON = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}


class QuestionsGradebook(CourseGradebook):
    """The gradebook of a course folder, with an assignment of `number` questions to each student."""

    def __init__(self, folder: Path, sheets: Sequence[Sheet], number: int) -> None:
        super().__init__(folder, exercises_folder())
        self._sheets = {sheet.student: sheet for sheet in sheets}
        self._names = [f"question_{place}" for place in range(1, number + 1)]

    def source_notebook(self, exercise: str) -> NotebookNode:
        """Return a notebook with the cells for the answers; each student has the questions on an own page."""
        return _notebook(Sheet("", exercise), dict.fromkeys(self._names, TO_ANSWER))

    def submitted_notebook(self, entry: Entry) -> NotebookNode:
        """Return a student's notebook with keys, and with the answers as text that cannot become live HTML."""
        shown = {}
        for place, name in enumerate(self._names, 1):
            answer = (entry.sources or {}).get(name) or entry.problem or "No written answer."
            shown[name] = f"### Answer {place}\n\n{_verbatim(answer)}"
        return _notebook(self._sheets[entry.grade.student], shown, with_keys=True)

    def is_marked(self, student: str, submitted: Path) -> bool:
        """Enter a student's questions and answers; return whether a person has given the points for all of them."""
        verdicts = [CheckVerdict(name, name, "to mark", 0, POINTS) for name in self._names]
        grade = Grade(assignment_of(self._sheets[student].exercise), student, BY_HAND, verdicts)
        try:
            entry = Entry(grade, answers_in(submitted / student, grade.exercise))
        except (UnusableSubmission, ValueError) as error:
            entry = Entry(grade, None, f"The answers cannot be read: {error}")
        return self.enter(entry) is not None


def assignment_of(exercise: str) -> str:
    """Return the name of the assignment with the questions about an exercise."""
    return f"{exercise}_questions"


def enter_questions(folder: Path, sheets: Sequence[Sheet], submitted: Path, number: int) -> int:
    """Enter the questions and the answers of all students; return how many students a person has marked.

    Raises:
        FolderInUse: a class is being graded into the folder.
        NbgraderError: nbgrader failed.
    """
    with locked(folder):
        gradebook = QuestionsGradebook(folder, sheets, number)
        return sum(gradebook.is_marked(sheet.student, submitted) for sheet in sheets)


def write_notebook(folder: Path, sheet: Sheet) -> None:
    """Write the notebook in which a student answers, without keys."""
    answers = {f"question_{place}": TO_ANSWER for place in range(1, len(sheet.questions) + 1)}
    name = f"{assignment_of(sheet.exercise)}.ipynb"
    write_atomically(folder / sheet.student / name, nbformat.writes(_notebook(sheet, answers)) + "\n")


def _notebook(sheet: Sheet, answers: Mapping[str, str], *, with_keys: bool = False) -> NotebookNode:
    """Return a notebook with the questions and a cell for each answer, whose text `answers` has by the cell's name."""
    title = f"# {sheet.exercise}: questions about your own program"
    cells = [new_markdown_cell(title, id="title")]
    for place, (name, answer) in enumerate(answers.items()):
        asked, keys = [""], [NO_QUESTION, sheet.note]
        for question in sheet.questions[place : place + 1]:
            asked = [question.situation, *question.lettered([part.asked for part in question.parts])]
            keys = question.lettered([part.key for part in question.parts])
        shown = f"### Question {place + 1}\n\n{html_of(*asked)}"
        cells.append(new_markdown_cell(shown, id=f"asked-{place}"))
        if with_keys:
            shown = f"**Key, for the examiner**\n\n{html_of(*keys)}"
            cells.append(new_markdown_cell(shown, id=f"{KEY}{place}"))
        metadata = cell_metadata(name, points=POINTS, solution=True)
        cells.append(new_markdown_cell(answer, id=name, metadata=metadata))
    if sheet.program:
        lines = [f"{line:4}  {code}" for line, code in enumerate(sheet.program.split("\n"), 1)]
        listing = _verbatim("\n".join(lines))
        shown = f"### The program, with the numbers of its lines\n\n{listing}"
        cells.append(new_markdown_cell(shown, id="program"))
    return new_notebook(cells=cells, metadata=_PYTHON)


def _verbatim(text: str) -> str:
    """Return Markdown that shows a text as it is, whatever is in it."""
    fence = "`" * (1 + max([2, *map(len, re.findall("`+", text))]))
    return f"{fence}text\n{text}\n{fence}"


def answers_in(folder: Path, assignment: str) -> dict[str, str]:
    """Return the answers that a student has written, by the names of their cells; links are not followed.

    Raises:
        UnusableSubmission: the file cannot be read.
        ValueError: the file is no notebook.
    """
    name = f"{assignment}.ipynb"
    found = [path for path in (folder / assignment / name, folder / name) if os.path.lexists(path)]
    if not found or found[0].parent.is_symlink():
        return {}
    cells = cells_in(OwnFile(found[0]).read(most_bytes(name)).decode("utf-8-sig"))
    texts = {_grade_id(cell): printable(source_of(cell))[:LONGEST_ANSWER] for cell in cells}
    return {name: text for name, text in texts.items() if text.strip() not in ("", TO_ANSWER)}


def _grade_id(cell: Mapping[str, Any]) -> str:
    match cell.get("metadata"):
        case {"nbgrader": {"grade_id": str(name)}}:
            return name
    return ""
