"""`course collect`: copies submissions from a platform's download to the folders that `course grade` reads."""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.collect import canvas, classroom50, gradescope, moodle
from autograder.classroom.collect.choice import choose
from autograder.classroom.collect.download import open_download
from autograder.classroom.collect.handed_in import Assignment, Reading
from autograder.classroom.collect.placing import Placed, place
from autograder.classroom.dates import read_deadlines
from autograder.engine.exercise import UnknownExercise, all_names
from autograder.engine.hand_in import work_in
from autograder.engine.submission import UnusableSubmission, read_submission
from autograder.report.console import BAD, NOTICE
from course_cli.options import CourseOption, DatesOption
from ros_runtime.course_error import COMMAND_FAILED, CommandFailed, CourseError

# The reader of each platform's downloads.
PLATFORMS = {"canvas": canvas, "moodle": moodle, "gradescope": gradescope, "classroom50": classroom50}
PlatformName = Enum("PlatformName", {name: name for name in PLATFORMS}, type=str)  # type: ignore[misc]


def collect(
    download: Annotated[Path, typer.Argument(help="the zip file, or the folder it was unpacked to")],
    platform: Annotated[PlatformName, typer.Option("--from", help="the platform it comes from")],
    out: Annotated[Path, typer.Option(help="folder for <student>/<exercise>/", file_okay=False)] = Path(
        "submitted"
    ),
    exercise: Annotated[
        str,
        typer.Option(
            help="the exercise of this download: collect only its files, and accept a notebook or program of any name"
        ),
    ] = "",
    assignment: Annotated[
        str,
        typer.Option(
            metavar="SLUG", help="Classroom 50's name for the exercise, if it differs; needs --exercise"
        ),
    ] = "",
    overwrite: Annotated[
        bool,
        typer.Option(
            "--overwrite", help="replace submissions that are already in --out, such as earlier hand-ins"
        ),
    ] = False,
    dates: DatesOption = None,
    course: CourseOption = None,
) -> None:
    """Copy submissions from a platform's download to the folders that `course grade` reads."""
    console = Console(highlight=False)
    deadlines = read_deadlines(dates, out)
    try:
        _require_usable(exercise, assignment)
        wanted = Assignment(exercise, assignment)
        with open_download(download) as opened:
            source = PLATFORMS[platform.value]
            reading = source.read(opened, wanted)
            reading.refused += opened.refused
            choice = choose(reading.files, wanted)
            if not choice.works and not reading.refused:
                aside = [*reading.unknown, *choice.left_aside]
                found = f"found {aside[0]}" if aside else "it is empty"
                raise CourseError(
                    f"{download} holds nothing to grade: expected {source.EXPECTED}; {found}"
                    + (f", and {len(aside) - 1} more" if len(aside) > 1 else "")
                )
            placed = place(choice, out, overwrite=overwrite)
    except OSError as error:
        raise CommandFailed(f"{out} cannot be written: {error}") from error
    for line in [*reading.unknown, *choice.left_aside]:
        console.print(f"left aside: {line}", style=NOTICE, markup=False)
    if without := {one.student for one in reading.files} - {student for student, _ in choice.works}:
        console.print(
            f"no submission from: {', '.join(sorted(without))}"
            + ("" if exercise else "; --exercise NAME accepts a file of any name"),
            style=NOTICE,
            markup=False,
        )
    _print_summary(console, reading, placed, out)
    times = {key: time for key, time in choice.timestamps.items() if key not in placed.unchanged}
    for line in deadlines.lateness(times) if deadlines else ():
        console.print(line, style=NOTICE, markup=False, soft_wrap=True)
    raise typer.Exit(COMMAND_FAILED if reading.refused or placed.refused else 0)


def _require_usable(exercise: str, assignment: str) -> None:
    if exercise and exercise not in all_names():
        raise UnknownExercise(f"there is no exercise {exercise!r}; there are {', '.join(all_names())}")
    if assignment and not exercise:
        raise UnknownExercise("--assignment SLUG is the platform's name for an exercise: add --exercise NAME")


def _print_summary(console: Console, reading: Reading, placed: Placed, out: Path) -> None:
    for line in [*reading.refused, *placed.refused]:
        console.print(f"refused: {line}", style=BAD, markup=False)
    late = sorted({one.student for one in reading.files if one.late})
    if late:
        console.print(f"late, according to the platform: {', '.join(late)}", markup=False)
    for student, exercise in placed.written:
        line = f"{student} · {exercise}  {_fingerprint(out / student / exercise, exercise)}"
        console.print(line, style="dim", markup=False, soft_wrap=True)
    students = {student for student, _ in [*placed.written, *placed.unchanged]}
    unchanged = f", {len(placed.unchanged)} unchanged" if placed.unchanged else ""
    console.print(
        f"{len(placed.written)} submissions written to {out}{unchanged}; {len(students)} students in all",
        markup=False,
        soft_wrap=True,
    )
    if placed.written:
        console.print(f"grade them: ./course grade {out}", style="dim", markup=False)


def _fingerprint(folder: Path, exercise: str) -> str:
    """Return the fingerprint of a submission, as `course submit` printed it to the student."""
    try:
        path, _ = work_in(folder, exercise, depth=0) or (folder, [])
        return f"fingerprint {read_submission(path, exercise).fingerprint}"
    except UnusableSubmission:
        return "cannot be read as a submission: `course grade` says why"
