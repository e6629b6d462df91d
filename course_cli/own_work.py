"""Which file of a student a command works on, if none is named."""

from __future__ import annotations

import os
from pathlib import Path

from autograder.engine.exercise import exercise_names, submission_names
from autograder.engine.hand_in import MOST_FOLDERS, PROGRAMS_DIFFER, work_in
from autograder.engine.submission import UnusableSubmission
from ros_runtime.project import COURSE, WORK
from ros_runtime.terminal import as_typed

MAX_DEPTH_HERE = 2  # levels of folders to search below the current folder


def own_work(exercise: str, file: Path | None, naming: str = "check {} FILE") -> tuple[Path, list[str]]:
    """Return the student's file, and a sentence on each other file of the exercise in its folder.

    Raises:
        UnusableSubmission: there is none; the message says how to name one, with the exercise at {} of `naming`.
    """
    if file and not file.is_dir():
        for other in exercise_names():
            if other != exercise and file.name in submission_names(other):
                wanted = as_typed(naming.format(other).replace("FILE", str(file)))
                raise UnusableSubmission(
                    f"{file} is a file of {other}: {wanted}, or give the file another name"
                )
        return file, []
    here = Path()
    own = Path("exercises") / exercise
    course = WORK.resolve()
    in_course = Path(os.path.relpath(course / own)) if here.resolve().is_relative_to(course) else own
    # The clone's own folders hold the grader's test submissions.
    below = 0 if here.resolve() == COURSE else MAX_DEPTH_HERE
    places = [(here, 0), (own, MOST_FOLDERS), (here, below), (in_course, MOST_FOLDERS)]
    if file:
        places = [(file, MOST_FOLDERS)]
    for folder, depth in places:
        if folder.is_dir() and (found := work_in(folder, exercise, depth=depth)):
            path, left_aside = found
            advice = ": its %%writefile cell was changed and not run since. Run it, and check"
            advice *= path.suffix == ".ipynb"
            return path, [line + advice * line.endswith(PROGRAMS_DIFFER) for line in left_aside]
    names = ", ".join(submission_names(exercise))
    folders = str(file) if file else f"this folder and {in_course}"
    raise UnusableSubmission(
        f"found none of {names} in {folders}; name your file: {as_typed(naming.format(exercise))}"
    )
