"""`course export`: writes the grades of a batch for another platform."""

from __future__ import annotations

import os
from dataclasses import replace
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.batch.selection import select
from autograder.classroom.export.formats import FORMATS, Export, LeftOut, read_batch
from autograder.classroom.export.formats import export as make_export
from autograder.classroom.export.published import Options, UnusableBatch
from autograder.classroom.pages.history import FILE as HISTORY
from autograder.classroom.pages.history import HIDDEN, history_text, read_history, with_day
from autograder.classroom.pages.pages import page_to_send
from autograder.report.console import BAD, NOTICE
from ros_runtime.course_error import COMMAND_FAILED, CommandFailed

Format = Enum("Format", {name: name for name in FORMATS}, type=str)  # type: ignore[misc]


class Hidden(str, Enum):
    """How hidden checks are exported."""

    hide = "hide"
    show = "show"


def export(
    format_: Annotated[Format, typer.Option("--format", help="the platform, or csv for one table")],
    out: Annotated[
        Path | None,
        typer.Option(help="folder to write to (default: exports/FORMAT beside the grades)", file_okay=False),
    ] = None,
    source: Annotated[
        Path,
        typer.Option(
            "--from",
            metavar="FOLDER",
            help="the output folder of `course grade`, or the file of `course check --json`",
        ),
    ] = Path("graded"),
    hidden: Annotated[
        Hidden,
        typer.Option(
            help="hide: students see only the total points of the hidden checks; show: everything, for you alone"
        ),
    ] = Hidden.hide,
    roster: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="the platform's list of students: for Canvas the gradebook's export, for Moodle a table with student "
            "and useremail or useridnumber, or an assignment's grading worksheet",
        ),
    ] = None,
    exercise: Annotated[
        list[str] | None,
        typer.Option(
            "--exercise", help="export only this exercise (can be repeated); files of other exercises stay"
        ),
    ] = None,
    assignment: Annotated[
        list[str] | None,
        typer.Option(
            "--assignment",
            metavar="EXERCISE=ID",
            help="the platform's id of an exercise: Canvas' number or Classroom 50's slug (can be repeated)",
        ),
    ] = None,
    classroom: Annotated[str, typer.Option(help="the classroom's name in Classroom 50")] = "",
) -> None:
    """Write the grades of a batch for another platform; "not graded" never becomes a zero."""
    console = Console(highlight=False)
    found, graded_at = read_batch(source)
    grades = select(found, (), exercise or ())
    graded = source if source.is_dir() else source.parent
    options = Options(
        graded_at,
        hidden.value,
        roster,
        _assignments(assignment or [], {grade.exercise for grade in grades}),
        classroom,
        # In a job that Classroom 50 runs, these variables identify the submission.
        {name: value for name, value in os.environ.items() if len(grades) == 1 or name == "CLASSROOM"},
        partial(page_to_send, graded),
    )
    made = make_export(format_.value, grades, options)
    if format_.value == "csv":
        days = with_day(read_history(graded), graded_at.date().isoformat(), grades)
        text = history_text(
            row
            for row in days
            if (hidden is Hidden.show or row.visibility != HIDDEN)
            and (not exercise or row.exercise in exercise)
        )
        made = replace(made, files={**made.files, HISTORY: text}, places=[*made.places, HISTORY])
    folder = out or graded / "exports" / format_.value
    try:
        made.write(folder)
    except OSError as error:
        raise CommandFailed(f"{folder} cannot be written: {error}") from error
    _print_summary(console, made, folder)
    is_score_lost = any(left.has_score for left in made.left_out)
    # Classroom 50's format cannot express “not graded”, so only the exit status reports it.
    is_unreported = format_.value == "classroom50" and any(left.why == "not graded" for left in made.left_out)
    raise typer.Exit(COMMAND_FAILED if is_score_lost or is_unreported else 0)


def _print_summary(console: Console, made: Export, folder: Path) -> None:
    """Print what was written, and name each submission without a score in the export."""
    for note in made.notes:
        console.print(note, style=NOTICE, markup=False)
    for left in made.left_out:
        console.print(_sentence(left), style=BAD if left.has_score else NOTICE, markup=False)
    files = "1 file" if len(made.files) == 1 else f"{len(made.files)} files"
    console.print(f"{files} in {folder}", markup=False, soft_wrap=True)


def _sentence(left: LeftOut) -> str:
    return f"exported without a score: {left.student}'s {left.exercise}: {left.why}"


def _assignments(given: list[str], exercises: set[str]) -> dict[str, str]:
    """Read EXERCISE=ID; raises `UnusableBatch`."""
    found: dict[str, str] = {}
    for text in given:
        exercise, sign, number = text.partition("=")
        if not sign or not number or exercise not in exercises:
            raise UnusableBatch(
                f"--assignment {text}: expected EXERCISE=ID with one of {', '.join(sorted(exercises))}"
            )
        found[exercise] = number
    return found
