"""`course release`: writes the students' archive, or only their notebooks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.archives.released_part import part_of
from autograder.classroom.archives.student_bundle import write_bundle
from autograder.classroom.nbgrader_bridge.release import bring_up_to_date, out_of_date
from autograder.engine.exercise import exercises_folder
from autograder.report.console import BAD
from course_cli.options import CourseOption
from ros_runtime.course_error import COMMAND_FAILED, CourseError
from ros_runtime.project import PROJECT


def release(
    out: Annotated[Path, typer.Option(help="the archive to write", dir_okay=False)] = Path("students.zip"),
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
    wanted: Annotated[
        list[str] | None,
        typer.Option("--for", metavar="EXERCISES", help="only these exercises, separated by commas"),
    ] = None,
    until: Annotated[
        str,
        typer.Option(
            metavar="CHAPTER",
            help="only the chapters up to this one, such as 7, and without --for their exercises",
        ),
    ] = "",
    course: CourseOption = None,
) -> None:
    """Write the students' archive, without solutions and hidden checks."""
    console = Console(highlight=False)
    if check:
        _report_differences(console)
    elif exercises:
        _update(console)
    else:
        _write(console, out, wanted or [], until)


def _report_differences(console: Console) -> None:
    solutions = exercises_folder()
    differing = out_of_date(solutions, solutions.parent / "exercises")
    for path in differing:
        console.print(f"{path.relative_to(solutions.parent)} is out of date", style=BAD, markup=False)
    if differing:
        console.print("Run ./course release --exercises and commit the changes.")
    raise typer.Exit(COMMAND_FAILED if differing else 0)


def _update(console: Console) -> None:
    solutions = exercises_folder()
    for path in bring_up_to_date(solutions, solutions.parent / "exercises"):
        console.print(f"{path.relative_to(solutions.parent)} updated", markup=False)


def _write(console: Console, out: Path, wanted: Sequence[str], until: str) -> None:
    chapters = PROJECT / "chapters"
    if not (chapters / "README.md").exists():
        raise CourseError(
            f"the archive holds the course's chapters, and {PROJECT} has none: it is an installed toolkit.\n"
            "Next: run this in a clone of the course; or hand out what `course release --exercises` writes."
        )
    count = write_bundle(PROJECT, out, part_of(chapters, wanted, until))
    console.print(f"{out}: {count} files, {out.stat().st_size / 1e6:.1f} MB", markup=False)
