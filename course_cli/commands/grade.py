"""`course grade`: grade the submissions of a class, up to gradebook and feedback pages."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from contextlib import closing, nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from autograder.batch.cache import GradeCache
from autograder.batch.collection import Collection, NoSubmissions, collect
from autograder.batch.crew import Workers
from autograder.batch.dask_workers import Cluster, NoCluster, dask_cluster
from autograder.batch.folder_lock import FolderInUse, locked
from autograder.batch.records import GRADES, read_grades, write_grades
from autograder.batch.runner import BatchRunner, Graded
from autograder.batch.seeds import Seeds
from autograder.batch.selection import (
    NothingSelected,
    OtherSeed,
    require_seed,
    select,
    with_others,
)
from autograder.engine.exercise import UnusableExercise, exercises_folder
from autograder.engine.verdict import Grade
from autograder.isolation.availability import Isolation, available_isolation
from autograder.nbgrader_bridge.course_folder import NbgraderError
from autograder.nbgrader_bridge.gradebook import CourseGradebook, Entry
from autograder.nbgrader_bridge.rebuild_submission import NoSolutionCell
from autograder.report.class_table import class_table, progress_line
from course_cli.ending import COULD_NOT, UNUSABLE, ended
from course_cli.exercises_option import CourseOption
from course_cli.jobs_option import JobsOption

LOG = "nbgrader.log"


def grade(
    submitted: Annotated[
        Path,
        typer.Argument(help="nbgrader's submitted/<student>/<exercise>/ layout, or <student>/<exercise>.py"),
    ],
    out: Annotated[Path, typer.Option(help="folder for grades.json, gradebook.db and feedback/")] = Path(
        "graded"
    ),
    jobs: JobsOption = os.cpu_count() or 1,
    resume: Annotated[bool, typer.Option("--resume", help="keep the grades of an earlier run")] = False,
    seed: Annotated[
        int, typer.Option(help="seed of the inputs of hidden checks, which are the same for all students")
    ] = 0,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="write all verdicts to this file as well")
    ] = None,
    dask: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS", help="grade on the workers of this Dask scheduler, such as tcp://10.0.0.1:8786"
        ),
    ] = None,
    student: Annotated[
        list[str] | None,
        typer.Option(
            "--student", help="grade only this student's; repeat it for several. Others keep their grades"
        ),
    ] = None,
    exercise: Annotated[
        list[str] | None,
        typer.Option(
            "--exercise", help="grade only this exercise; repeat it for several. Others keep their grades"
        ),
    ] = None,
    course: CourseOption = None,
) -> None:
    """Grade a batch of submissions."""
    console = Console(highlight=False)
    try:
        collection = collect(submitted)
        works = select(collection.works, student or [], exercise or [])
    except (NoSubmissions, NothingSelected) as error:
        raise ended(console, error, UNUSABLE) from error
    try:
        with locked(out), dask_cluster(dask) if dask else nullcontext() as cluster:
            _grade_into(
                console,
                replace(collection, works=works),
                out,
                jobs,
                resume,
                seed,
                json_file,
                bool(student or exercise),
                cluster,
            )
    except (FolderInUse, NoCluster) as error:
        raise ended(console, error, COULD_NOT) from error


def _grade_into(
    console: Console,
    collection: Collection,
    out: Path,
    jobs: int,
    resume: bool,
    seed: int,
    json_file: Path | None,
    keep_others: bool,
    cluster: Cluster | None,
) -> None:
    """Grade the collection and write everything; raises typer.Exit with the command's status."""
    before = read_grades(out / GRADES) if keep_others else []
    try:
        require_seed(before, seed)
    except OtherSeed as error:
        raise ended(console, error, UNUSABLE) from error
    isolation = cluster.isolation if cluster else available_isolation()
    if cluster:
        console.print(f"{cluster.size} workers, isolation: {isolation.label}", style="dim")
        for line in cluster.left_out:
            console.print(line, style="yellow", markup=False)
    if not isolation.trusted:
        console.print(
            f"No isolation: {isolation.reason}. Only visible checks are made and the grades are marked untrusted; run "
            "this only with submissions you trust.",
            style="yellow",
            markup=False,
        )
    try:
        results = _grade_all(
            console, collection, out, isolation, jobs, seed, resume, cluster.workers if cluster else None
        )
    except UnusableExercise as error:
        raise ended(console, error, UNUSABLE) from error
    write_grades(out / GRADES, with_others([result.grade for result in results], before))
    unentered, grades = _enter_all(console, results, out)
    grades = with_others(grades, before)
    write_grades(out / GRADES, grades)  # again, with the points that a person has given for essays
    if json_file:
        write_grades(json_file, grades)
    console.print(class_table(grades))
    for line in collection.ignored:
        console.print(f"left aside: {line}", style="yellow", markup=False)
    for line in collection.refused:
        console.print(f"not graded: {line}", style="red", markup=False)
    for line in unentered:
        console.print(f"not in the gradebook: {line}", style="red", markup=False)
    to_mark = [grade for grade in grades if grade.status == "to mark"]
    if to_mark:
        console.print(
            f"{len(to_mark)} to be marked by hand, in formgrader; then run this again, and the points are in {GRADES}",
            style="cyan",
        )
    not_graded = [result for result in results if result.grade.status == "not graded"]
    if not_graded:
        console.print(f"{len(not_graded)} not graded; try those again with --resume", style="magenta")
    console.print(f"{out / GRADES}, {out / 'gradebook.db'}, {out / 'feedback'}/", style="dim", markup=False)
    jupyter = Path(sys.executable).with_name("jupyter")
    console.print(
        f"to look at them in nbgrader: cd {out} && {jupyter} lab, then Nbgrader > Formgrader", style="dim"
    )
    raise typer.Exit(COULD_NOT if unentered or not_graded or collection.refused else 0)


def _grade_all(
    console: Console,
    collection: Collection,
    out: Path,
    isolation: Isolation,
    jobs: int,
    seed: int,
    resume: bool,
    workers: Workers | None,
) -> list[Graded]:
    """Grade in parallel and return the results in the order of the submissions."""
    with _progress(console) as progress:
        task = progress.add_task("checks", total=None)
        runner = BatchRunner(
            GradeCache(out / "cache", isolation),
            isolation,
            jobs=jobs,
            seeds=Seeds(seed),
            resume=resume,
            workers=workers,
            report=lambda verdict: progress.advance(task),
        )
        progress.update(task, total=sum(runner.count(work.exercise) for work in collection.works))
        results: dict[object, Graded] = {}
        try:
            with closing(runner.run(collection.works)) as graded:
                for result in graded:
                    results[result.work] = result
                    progress.print(progress_line(result.grade, cached=result.cached))
        except KeyboardInterrupt:
            console.print("Interrupted. Add --resume to go on where it stopped.", style="yellow")
            raise typer.Exit(COULD_NOT) from None
    return [results[work] for work in collection.works]


def _enter_all(console: Console, results: Sequence[Graded], out: Path) -> tuple[list[str], list[Grade]]:
    """Enter the grades into nbgrader's gradebook one by one.

    Returns a sentence for each that failed, and the grades with what a person has given there.
    """
    problems: list[str] = []
    grades: list[Grade] = []
    logs: list[str] = []
    with _progress(console) as progress:
        task = progress.add_task("gradebook", total=len(results))
        gradebook = CourseGradebook(out, exercises_folder())
        for result in results:
            try:
                gradebook.enter(Entry(result.grade, result.sources, result.problem, result.work.timestamp))
                grades.append(gradebook.as_marked(result.grade))
            except (NbgraderError, NoSolutionCell, OSError) as error:
                grades.append(result.grade)
                problems.append(f"{result.work.student}'s {result.work.exercise}: {error}")
                if isinstance(error, NbgraderError):
                    logs.append(f"{problems[-1]}\n{error.log}")
            progress.advance(task)
    if logs:
        (out / LOG).write_text("\n\n".join(logs))
        problems.append(f"what nbgrader said about it is in {out / LOG}")
    return problems, grades


def _progress(console: Console) -> Progress:
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(elapsed_when_finished=True),
        console=console,
    )
