"""`course grade`: grades the submissions of a class, and writes the gradebook and the feedback pages."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.batch.request import BatchRequest
from autograder.classroom.batch.shards import Shard
from autograder.classroom.class_grading.once import grade_once
from autograder.classroom.class_grading.watching import watch_and_grade
from autograder.classroom.dates import read_deadlines
from autograder.report.console import NOTICE
from course_cli.options import CourseOption, DatesOption, JobsOption
from ros_runtime.course_error import COMMAND_FAILED, CourseError


def grade(
    submitted: Annotated[
        Path | None,
        typer.Argument(help="nbgrader's submitted/<student>/<exercise>/ layout, or <student>/<exercise>.py"),
    ] = None,
    watch: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER", help="grade this folder, and keep grading new submissions in it until Ctrl-C"
        ),
    ] = None,
    out: Annotated[
        Path,
        typer.Option(
            help="folder for grades.json, gradebook.db, batch.json, sources/ and feedback/", file_okay=False
        ),
    ] = Path("graded"),
    jobs: JobsOption = os.cpu_count() or 1,
    resume: Annotated[bool, typer.Option("--resume", help="keep the grades of an earlier run")] = False,
    seed: Annotated[
        int | None,
        typer.Option(
            help="seed of the inputs of hidden checks, the same for all students (default: a new one for each batch)"
        ),
    ] = None,
    seed_per_student: Annotated[
        bool,
        typer.Option(
            "--seed-per-student", help="draw different inputs for each student, from the seed and the name"
        ),
    ] = False,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="write all verdicts to this file as well", dir_okay=False)
    ] = None,
    dask: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS", help="grade on the workers of this Dask scheduler, such as tcp://10.0.0.1:8786"
        ),
    ] = None,
    shard: Annotated[
        str | None,
        typer.Option(
            metavar="K/N", help="grade part K of N, without a gradebook; `course merge` merges the parts"
        ),
    ] = None,
    student: Annotated[
        list[str] | None,
        typer.Option(
            "--student",
            help="grade only this student's submissions (can be repeated); other students keep their grades",
        ),
    ] = None,
    exercise: Annotated[
        list[str] | None,
        typer.Option(
            "--exercise", help="grade only this exercise (can be repeated); other exercises keep their grades"
        ),
    ] = None,
    record: Annotated[
        bool,
        typer.Option(
            "--record", help="keep an MCAP file of each scenario in OUT/recordings (`course replay`)"
        ),
    ] = False,
    dates: DatesOption = None,
    course: CourseOption = None,
) -> None:
    """Grade a batch of submissions."""
    console = Console(highlight=False)
    folder = _one_folder(submitted, watch)
    request = BatchRequest(
        submitted=folder,
        out=out,
        jobs=jobs,
        resume=resume,
        seed=seed,
        seed_per_student=seed_per_student,
        students=tuple(student or ()),
        exercises=tuple(exercise or ()),
        shard=Shard.parse(shard) if shard else None,
        dask=dask,
        json_file=json_file,
        watch=watch is not None,
        record=record,
        deadlines=read_deadlines(dates, folder),
    )
    try:
        status = watch_and_grade(console, request) if request.watch else grade_once(console, request)
    except KeyboardInterrupt:
        console.print("Interrupted. Add --resume to continue.", style=NOTICE)
        raise typer.Exit(COMMAND_FAILED) from None
    raise typer.Exit(status)


def _one_folder(submitted: Path | None, watched: Path | None) -> Path:
    """Return the folder to grade; raises `CourseError` unless exactly one is given."""
    folder = watched or submitted
    if folder is None or (watched and submitted):
        raise CourseError(
            "give one folder of submissions: course grade FOLDER, or course grade --watch FOLDER"
        )
    return folder
