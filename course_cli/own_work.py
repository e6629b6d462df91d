"""Which file of a student a command works on, if none is named."""

from __future__ import annotations

from pathlib import Path

from autograder.engine.exercise import file_names
from autograder.engine.hand_in import MOST_FOLDERS, work_in
from autograder.engine.submission import UnusableSubmission
from ros_runtime.project import COURSE

MAX_DEPTH_HERE = 2  # levels of folders to search below the current folder


def own_work(exercise: str, file: Path | None) -> tuple[Path, list[str]]:
    """Return the student's file, and a sentence on each other file of the exercise in its folder.

    Raises:
        UnusableSubmission: there is none.
    """
    if file and not file.is_dir():
        return file, []
    here = Path()
    own = Path("exercises") / exercise
    # The clone's own folders hold the grader's test submissions.
    below = 0 if here.resolve() == COURSE else MAX_DEPTH_HERE
    places = [(file, MOST_FOLDERS)] if file else [(here, 0), (own, MOST_FOLDERS), (here, below)]
    for folder, depth in places:
        if folder.is_dir() and (found := work_in(folder, exercise, depth=depth)):
            return found
    names = ", ".join([f"{exercise}.ipynb", *file_names(exercise)])
    folders = str(file) if file else f"this folder and {own}"
    raise UnusableSubmission(
        f"found none of {names} in {folders}; name your file: ./course check {exercise} FILE"
    )
