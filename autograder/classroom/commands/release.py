"""`course release`: write the students' archive, or only their notebooks."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.archives.student_bundle import write_bundle
from autograder.classroom.nbgrader_bridge.course_folder import NbgraderError
from autograder.classroom.nbgrader_bridge.release import bring_up_to_date, out_of_date
from autograder.engine.exercise import exercises_folder
from course_cli.ending import COMMAND_FAILED, UNUSABLE, ended
from course_cli.options import CourseOption
from ros_runtime.project import PROJECT


def release(
    out: Annotated[Path, typer.Option(help="the archive to write")] = Path("students.zip"),
    exercises: Annotated[
        bool,
        typer.Option(
            "--exercises",
            help="only generate exercises/ and the grade cells of solutions/ from solutions/ and the checks",
        ),
    ] = False,
    check: Annotated[
        bool,
        typer.Option(
            "--check",
            help="only report whether solutions/ and exercises/ are up to date; exit status 1 if not",
        ),
    ] = False,
    course: CourseOption = None,
) -> None:
    """Write the students' archive, without solutions and hidden checks."""
    console = Console(highlight=False)
    try:
        _release(console, out, exercises, check)
    except NbgraderError as error:
        raise ended(console, error, UNUSABLE) from error


def _release(console: Console, out: Path, exercises: bool, check: bool) -> None:
    solutions = exercises_folder()
    released = solutions.parent / "exercises"
    if check:
        differing = out_of_date(solutions, released)
        for path in differing:
            console.print(f"{path.relative_to(solutions.parent)} is out of date", style="red", markup=False)
        if differing:
            console.print("Run ./course release --exercises and commit what it changes.")
        raise typer.Exit(COMMAND_FAILED if differing else 0)
    if exercises:
        for path in bring_up_to_date(solutions, released):
            console.print(f"{path.relative_to(solutions.parent)} renewed", markup=False)
        return
    count = write_bundle(PROJECT, out)
    console.print(f"{out}: {count} files, {out.stat().st_size / 1e6:.1f} MB", markup=False)
