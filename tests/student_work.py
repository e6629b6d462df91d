"""The work of a student that is one file."""

from __future__ import annotations

from pathlib import Path, PurePath

from autograder.classroom.batch.collection import Work
from autograder.engine.exercise import file_names
from autograder.engine.hand_in import Candidate, OwnFile


def work_at(path: Path, student: str, exercise: str) -> Work:
    """Return the notebook or program at this place as a student's work, whatever it is called."""
    name = path.name if path.suffix == ".ipynb" else file_names(exercise)[0]
    return Work(student, exercise, (Candidate(exercise, PurePath(path.name), {name: OwnFile(path)}),))
