"""An exercise without a program to run: a person marks it by the criteria of its rubric."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from autograder.authoring.rubric import Criterion, Picture, criteria_in, picture_in
from autograder.engine.exercise import RUBRIC, UnusableExercise, exercise_module, exercises_folder
from autograder.engine.verdict import CheckVerdict, Grade

BY_HAND = "by hand"  # the isolation in a grade without an arena


@dataclass(frozen=True)
class Essay:
    """The criteria of one essay, and the function that draws the submitted files for the marker."""

    name: str
    folder: Path
    criteria: Sequence[Criterion]
    picture: Picture | None


def load_essay(name: str) -> Essay:
    """Load an essay.

    Raises:
        UnknownExercise: there is none of that name.
        UnusableExercise: its author has something to fix.
    """
    module = exercise_module(name, RUBRIC)
    try:
        return Essay(name, exercises_folder() / name, criteria_in(module), picture_in(module))
    except ValueError as error:
        raise UnusableExercise(f"the rubric of {name} cannot be used: {error}") from error


def unmarked_grade(essay: Essay, student: str) -> Grade:
    """Return the record of an essay that nobody has marked yet: status "to mark", without a score."""
    verdicts = [
        CheckVerdict(criterion.id, criterion.title, "to mark", 0, criterion.points)
        for criterion in essay.criteria
    ]
    return Grade(essay.name, student, BY_HAND, verdicts)
