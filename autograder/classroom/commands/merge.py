"""`course merge`: join the parts of a class that `course grade --shard K/N` graded."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.batch.batch_record import merged_record, write_batch
from autograder.classroom.batch.folder_lock import locked
from autograder.classroom.batch.records import GRADES, write_grades
from autograder.classroom.batch.shards import Merged, merge_shards
from autograder.classroom.batch.source_files import write_base_code, write_sources
from autograder.classroom.class_grading.output import enter_all, sources_of, tell_the_end
from autograder.classroom.nbgrader_bridge.course_folder import RELEASE
from autograder.classroom.pages.pages import write_pages
from autograder.recording.kept import FOLDER as RECORDINGS
from course_cli.ending import batch_status
from course_cli.options import CourseOption


def merge(
    folders: Annotated[list[Path], typer.Argument(metavar="FOLDER...", help="output folders of the shards")],
    out: Annotated[Path, typer.Option(help="folder for grades.json, gradebook.db and feedback/")] = Path(
        "graded"
    ),
    course: CourseOption = None,
) -> None:
    """Join the shards of a class into one gradebook."""
    console = Console(highlight=False)
    merged = merge_shards(folders)
    with locked(out):
        status = _write(console, merged, folders, out)
    raise typer.Exit(status)


def _write(console: Console, merged: Merged, folders: Sequence[Path], out: Path) -> int:
    """Write gradebook, grades and pages; return the exit status: 0 if all of the class has a grade in both."""
    write_grades(out / GRADES, [result.grade for result in merged.results])
    unentered, grades = enter_all(console, merged.results, out)
    write_grades(out / GRADES, grades)
    record = merged_record(folders)
    if record:
        record = record.with_points(grades)
        write_batch(out, record)
    write_sources(out, merged.results)
    write_base_code(out, [result.work.exercise for result in merged.results], out / RELEASE)
    page = write_pages(
        out,
        grades,
        sources_of(merged.results),
        batches=folders,
        batch=record.in_words() if record else None,
    )
    tell_the_end(console, grades, unentered, out, page)
    if recorded := [folder / RECORDINGS for folder in folders if (folder / RECORDINGS).is_dir()]:
        places = ", ".join(map(str, recorded))
        console.print(f"recordings are not merged; they stay in {places}", style="dim", markup=False)
    for line in merged.missing:
        console.print(f"missing: {line}", style="red", markup=False)
    not_graded = sum(grade.status == "not graded" for grade in grades)
    if not_graded:
        console.print(f"{not_graded} not graded; grade their shards again with --resume", style="magenta")
    return batch_status(not_graded=not_graded, complete=not (merged.missing or unentered))
