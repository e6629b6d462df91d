"""What a student has to know beside the points: which checks come later, and what would be handed in now."""

from __future__ import annotations

import re
from pathlib import Path

from rich.text import Text

from autograder.engine.hand_in import work_in
from autograder.engine.submission import UnusableSubmission, read_submission
from ros_runtime.project import COURSE

WARNING = "bold black on yellow"  # legible in a light notebook and in a dark one
_HIDDEN = re.compile(r"Hidden check \d+ \((\d+) points?\)")


def hidden_checks_notice(exercise: str) -> str:
    """Return how many hidden checks there are, and their points, as the exercise's notebook lists them."""
    notebook = COURSE / "exercises" / exercise / f"{exercise}.ipynb"
    points = (
        list(map(int, _HIDDEN.findall(notebook.read_text(encoding="utf-8")))) if notebook.exists() else []
    )
    if not points:
        return ""
    return (
        f"When your work is graded, {len(points)} hidden checks add {sum(points)} points: they judge the same clauses "
        "in other situations."
    )


def saved_work_notice(exercise: str, program: str, folder: Path = Path()) -> Text:
    """Return whether the work that is saved in a folder is the program of this fingerprint, and what to do.

    Only a warning has a style.
    """
    found = work_in(folder, exercise, depth=0)
    if not found:
        return Text()
    saved = found[0]
    try:
        is_same = read_submission(saved, exercise).fingerprint == program
    except UnusableSubmission as error:
        return Text(f"What a grader would take cannot be read: {error}", WARNING)
    if is_same:
        advice = (
            f"{saved.name} is saved with the program that was checked. To hand it in: !course submit {exercise} in a "
            f"cell, or ./course submit {exercise} in a terminal"
        )
        return Text(advice)
    return Text(
        f"{saved.name}, which a grader would take, is saved with another program than the one checked here. "
        "Next: save it (Ctrl+S), run its %%writefile cell, and check again.",
        WARNING,
    )
