"""`course package`: writes autograders for other platforms."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.archives.gradescope_package import write_package
from autograder.engine.exercise import essay_names, exercise_names
from course_cli.options import CourseOption
from ros_runtime.course_error import CommandFailed, CourseError
from ros_runtime.project import PROJECT

package = typer.Typer(no_args_is_help=True)


@package.callback()
def platforms() -> None:
    """Make an autograder that another platform runs."""


@package.command()
def gradescope(
    exercise: Annotated[
        str, typer.Option(help="the assignment's exercise (default: the exercise whose file is uploaded)")
    ] = "",
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.zip", help="the archive (default: gradescope[_EXERCISE].zip)", dir_okay=False
        ),
    ] = None,
    course: CourseOption = None,
) -> None:
    """Make the zip file of a Gradescope autograder: it has visible checks, and runs submissions as another user."""
    console = Console(highlight=False)
    if exercise in essay_names():
        raise CourseError(f"{exercise} has no checks: a person marks it")
    if exercise and exercise not in exercise_names():
        raise CourseError(f"there is no exercise {exercise!r}; there are {', '.join(exercise_names())}")
    archive = out or Path(f"gradescope_{exercise}.zip" if exercise else "gradescope.zip")
    try:
        count = write_package(PROJECT, archive, exercise)
    except OSError as error:
        raise CommandFailed(str(error)) from error
    console.print(f"{archive}: {count} files, {archive.stat().st_size / 1e6:.1f} MB", markup=False)
