"""`course new`: creates the folder of a new exercise."""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.nbgrader_bridge.release import bring_up_to_date
from autograder.classroom.new_exercise.make import KINDS, make_exercise
from autograder.engine.exercise import exercises_folder, use_exercises_of

Kind = Enum("Kind", {kind: kind for kind in KINDS}, type=str)  # type: ignore[misc]


def new(
    exercise: Annotated[str, typer.Argument(help="the exercise's name, such as battery_service")],
    kind: Annotated[Kind, typer.Option(help="the kind of program that students write")],
    course: Annotated[
        Path | None,
        typer.Option(
            "--course",
            metavar="FOLDER",
            help="folder of exercises, created if missing (default: the folder of this course)",
        ),
    ] = None,
) -> None:
    """Create the folder of a new exercise: a working example that passes its own audit, for you to change."""
    console = Console(highlight=False)
    place = course or exercises_folder()
    folder = make_exercise(exercise, kind.value, place)
    use_exercises_of(place)
    bring_up_to_date(place, place.parent / "exercises")
    for path in sorted(path for path in folder.rglob("*") if path.is_file() and path.suffix != ".pyc"):
        console.print(f"  {path}", markup=False, soft_wrap=True)
    also = f" --course {course}" if course else ""
    console.print(
        f"Try it: ./course audit {exercise}{also}. Then change task, scenarios and checks, and audit it again.",
        soft_wrap=True,
    )
