"""What a student has to know beside the points: which checks come later, and what would be handed in now."""

from __future__ import annotations

import re
from pathlib import Path

from autograder.engine.hand_in import work_in
from autograder.engine.submission import UnusableSubmission, read_submission
from autograder.engine.verdict import Grade
from ros_runtime.project import COURSE
from ros_runtime.terminal import as_typed

WARNING = "bold black on yellow"  # legible in a light notebook and in a dark one
_HIDDEN = re.compile(r"Hidden check (\d+) \((\d+) points?\)")


def hidden_checks_notice(exercise: str) -> str:
    """Return how many hidden checks there are, and their points, as the exercise's notebook lists them."""
    notebook = COURSE / "exercises" / exercise / f"{exercise}.ipynb"
    text = notebook.read_text(encoding="utf-8") if notebook.exists() else ""
    # by number, because tracebacks quote the notebook's lines
    points = {number: int(worth) for number, worth in _HIDDEN.findall(text)}
    if not points:
        return ""
    return (
        f"When your work is graded, {len(points)} hidden checks add {sum(points.values())} points: they judge the same "
        "clauses in other situations."
    )


def saved_work_warning(exercise: str, program: str, folder: Path = Path()) -> str:
    """Return that the work saved in a folder is not the program of this fingerprint, and what to do; "" if it is."""
    found = work_in(folder, exercise, depth=0)
    if not found:
        return ""
    saved = found[0]
    try:
        if read_submission(saved, exercise).fingerprint == program:
            return ""
    except UnusableSubmission as error:
        return f"What a grader would take cannot be read: {error}"
    return (
        f"{saved.name}, which a grader would take, is saved with another program than the one checked here. "
        "Next: run its %%writefile cell, save it (Ctrl+S), and check again."
    )


def next_step(grade: Grade, offers_it: bool = True, file: Path | None = None) -> str:
    """Return what to do after a graded self-check of `file` (None: the default one).

    `offers_it`: whether to offer handing in a program that fails a check.
    """
    submit = as_typed(f"submit {grade.exercise}" + (f" --file {file}" if file else ""))
    if grade.all_passed:
        return f"Next: hand it in: {submit}"
    if not offers_it or not any(verdict.status == "passed" for verdict in grade.checks):
        return "Next: mend what the first failed check names, and check again."
    return (
        f"Next: mend what the first failed check names, and check again; or hand in what you have: {submit}"
    )
