"""Options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from autograder.engine.exercise import UnusableExercise, use_exercises_of


def _use(folder: Path | None) -> Path | None:
    """Select this folder of exercises before the command runs."""
    if folder is not None:
        try:
            use_exercises_of(folder)
        except UnusableExercise as error:
            raise typer.BadParameter(str(error)) from error
    return folder


CourseOption = Annotated[
    Path | None,
    typer.Option(
        "--course",
        metavar="FOLDER",
        help="a folder with the exercises of another course (default: those of this course)",
        callback=_use,
        is_eager=True,
    ),
]


DatesOption = Annotated[
    Path | None,
    typer.Option(
        "--dates",
        metavar="FILE",
        help="due times, late rule and extensions (default: dates.yaml beside the folder, if it exists)",
    ),
]

JobsOption = Annotated[
    int,
    typer.Option(
        min=1,
        metavar="NUMBER",
        help="number of checks that run at the same time; each needs a processor core",
    ),
]
