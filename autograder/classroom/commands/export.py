"""`course export`: write the grades of a batch for another platform."""

from __future__ import annotations

import os
from enum import Enum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.export.formats import FORMATS, Export, LeftOut, read_batch
from autograder.classroom.export.formats import export as make_export
from autograder.classroom.export.published import Options, UnusableBatch
from course_cli.ending import COMMAND_FAILED, ended

Format = Enum("Format", {name: name for name in FORMATS}, type=str)  # type: ignore[misc]


class Hidden(str, Enum):
    """How hidden checks are exported."""

    hide = "hide"
    show = "show"


def export(
    format_: Annotated[Format, typer.Option("--format", help="the platform, or csv for one table")],
    out: Annotated[
        Path | None, typer.Option(help="folder to write to (default: exports/FORMAT beside the grades)")
    ] = None,
    source: Annotated[
        Path,
        typer.Option(
            "--from",
            metavar="FOLDER",
            help="what `course grade --out` wrote, or the file of `course check --json`",
        ),
    ] = Path("graded"),
    hidden: Annotated[
        Hidden,
        typer.Option(
            help="hide: students learn the sum of the hidden checks' points; show: all, for you alone"
        ),
    ] = Hidden.hide,
    roster: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="the class as the platform knows it: the export of Canvas' gradebook; for Moodle a table with student "
            "and useremail or useridnumber, or an assignment's worksheet",
        ),
    ] = None,
    assignment: Annotated[
        list[str] | None,
        typer.Option(
            "--assignment",
            metavar="EXERCISE=ID",
            help="the platform's id of an exercise: Canvas' number or Classroom 50's slug; repeat it",
        ),
    ] = None,
    classroom: Annotated[str, typer.Option(help="the classroom's name in Classroom 50")] = "",
) -> None:
    """Write the grades of a batch for another platform; "not graded" is never a zero there."""
    console = Console(highlight=False)
    grades, graded_at = read_batch(source)
    options = Options(
        graded_at,
        hidden.value,
        roster,
        _assignments(assignment or [], {grade.exercise for grade in grades}),
        classroom,
        # In a job of Classroom 50 these variables identify the submission.
        {name: value for name, value in os.environ.items() if len(grades) == 1 or name == "CLASSROOM"},
    )
    made = make_export(format_.value, grades, options)
    folder = out or (source if source.is_dir() else source.parent) / "exports" / format_.value
    try:
        made.write(folder)
    except OSError as error:
        raise ended(console, f"{folder} cannot be written: {error}", COMMAND_FAILED) from error
    _tell(console, made, folder)
    lost = any(left.has_score for left in made.left_out)
    unsaid = format_.value == "classroom50" and any(left.why == "not graded" for left in made.left_out)
    raise typer.Exit(COMMAND_FAILED if lost or unsaid else 0)


def _tell(console: Console, made: Export, folder: Path) -> None:
    """Print what was written, and name each submission without a score in the export."""
    for note in made.notes:
        console.print(note, style="yellow", markup=False)
    for left in made.left_out:
        console.print(_sentence(left), style="red" if left.has_score else "magenta", markup=False)
    files = "1 file" if len(made.files) == 1 else f"{len(made.files)} files"
    console.print(f"{files} in {folder}", markup=False, soft_wrap=True)


def _sentence(left: LeftOut) -> str:
    return f"without a score there: {left.student}'s {left.exercise}: {left.why}"


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
