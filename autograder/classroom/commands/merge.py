"""`course merge`: merges the parts of a class that `course grade --shard K/N` graded."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.batch.batch_record import merged_record
from autograder.classroom.batch.folder_lock import locked
from autograder.classroom.batch.records import GRADES, write_grades
from autograder.classroom.batch.shards import merge_shards
from autograder.classroom.class_grading.class_files import ClassFiles
from autograder.classroom.class_grading.output import add_all, print_summary
from autograder.classroom.dates import read_deadlines
from autograder.recording.kept import FOLDER as RECORDINGS
from autograder.report.console import BAD, NOTICE
from course_cli.ending import batch_status
from course_cli.options import CourseOption, DatesOption


def merge(
    folders: Annotated[list[Path], typer.Argument(metavar="FOLDER...", help="output folders of the shards")],
    out: Annotated[
        Path, typer.Option(help="folder for grades.json, gradebook.db and feedback/", file_okay=False)
    ] = Path("graded"),
    dates: DatesOption = None,
    course: CourseOption = None,
) -> None:
    """Merge the shards of a class into one gradebook."""
    console = Console(highlight=False)
    merged = merge_shards(folders)
    with locked(out):
        grades = [result.grade for result in merged.results]
        write_grades(out / GRADES, grades)
        files = ClassFiles(
            out, grades, merged_record(folders), drawn_in=folders, deadlines=read_deadlines(dates, out)
        )
        add_all(console, files, merged.results)
        is_entered = print_summary(console, files, out, files.write())
    if recorded := [folder / RECORDINGS for folder in folders if (folder / RECORDINGS).is_dir()]:
        places = ", ".join(map(str, recorded))
        console.print(f"recordings are not merged; they stay in {places}", style="dim", markup=False)
    for line in merged.missing:
        console.print(f"missing: {line}", style=BAD, markup=False)
    not_graded = sum(grade.status == "not graded" for grade in files.grades)
    if not_graded:
        console.print(f"{not_graded} not graded; grade their shards again with --resume", style=NOTICE)
    complete = is_entered and not merged.missing
    raise typer.Exit(batch_status(not_graded=not_graded, complete=complete))
