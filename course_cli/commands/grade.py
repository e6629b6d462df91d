"""`course grade`: grade the submissions of a class, up to gradebook and feedback pages."""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import closing, nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.batch.cache import GradeCache
from autograder.batch.collection import Collection, NoSubmissions, Work, collect
from autograder.batch.crew import Workers
from autograder.batch.dask_workers import Cluster, NoCluster, dask_cluster
from autograder.batch.folder_lock import FolderInUse, locked
from autograder.batch.records import GRADES, UnusableRecord, read_grades, write_grades
from autograder.batch.runner import BatchRunner, Graded
from autograder.batch.seeds import Seeds
from autograder.batch.selection import (
    NothingSelected,
    OtherSeed,
    require_seed,
    select,
    with_others,
)
from autograder.batch.shards import SHARD, Shard, write_shard
from autograder.engine.exercise import UnusableExercise, exercises_folder
from autograder.engine.exposure import HiddenChecksRefused, require_hidden
from autograder.isolation.availability import Isolation, available_isolation
from autograder.report.class_table import progress_line
from autograder.report.classroom.drawings import Drawings
from autograder.report.classroom.pages import write_pages
from course_cli.class_output import bar, enter_all, sources_of, tell_the_end
from course_cli.ending import COULD_NOT, UNUSABLE, ended
from course_cli.exercises_option import CourseOption
from course_cli.jobs_option import JobsOption


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
    seed_per_student: Annotated[
        bool,
        typer.Option("--seed-per-student", help="other inputs for each student, made of --seed and the name"),
    ] = False,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="write all verdicts to this file as well")
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
            metavar="K/N", help="grade part K of N, without a gradebook; `course merge` joins the parts"
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
        part = Shard.parse(shard) if shard else None
        if part and (student or exercise or json_file):
            raise ValueError(
                "--shard takes a part of the whole class: leave out --student, --exercise and --json"
            )
    except (NoSubmissions, NothingSelected, ValueError) as error:
        raise ended(console, error, UNUSABLE) from error
    if part:
        works = part.part(works)
    try:
        if not dask and available_isolation().trusted:  # otherwise they could read it anywhere
            require_hidden([exercises_folder(), submitted, out])
        with locked(out), dask_cluster(dask) if dask else nullcontext() as cluster:
            _grade_into(
                console,
                replace(collection, works=works),
                out,
                jobs,
                resume,
                Seeds(seed, seed_per_student),
                json_file,
                bool(student or exercise),
                cluster,
                part,
                collection.works,
            )
    except (FolderInUse, HiddenChecksRefused, NoCluster) as error:
        raise ended(console, error, COULD_NOT) from error


def _grade_into(
    console: Console,
    collection: Collection,
    out: Path,
    jobs: int,
    resume: bool,
    seeds: Seeds,
    json_file: Path | None,
    keep_others: bool,
    cluster: Cluster | None,
    shard: Shard | None,
    whole_class: Sequence[Work],
) -> None:
    """Grade the collection and write everything; raises typer.Exit with the command's status."""
    try:
        before = read_grades(out / GRADES) if keep_others else []
        require_seed(before, seeds)
    except (OtherSeed, UnusableRecord) as error:
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
            console, collection, out, isolation, jobs, seeds, resume, cluster.workers if cluster else None
        )
    except UnusableExercise as error:
        raise ended(console, error, UNUSABLE) from error
    if shard:
        write_grades(out / GRADES, [result.grade for result in results])
        write_shard(out, shard, seeds, whole_class, results)
        not_graded = _tell_what_is_left(console, collection, results)
        console.print(f"{out / SHARD}; join all of them with `course merge`", style="dim", markup=False)
        raise typer.Exit(COULD_NOT if not_graded or collection.refused else 0)
    write_grades(out / GRADES, with_others([result.grade for result in results], before))
    unentered, grades = enter_all(console, results, out)
    grades = with_others(grades, before)
    write_grades(out / GRADES, grades)  # again, with the points that a person has given for essays
    if json_file:
        write_grades(json_file, grades)
    page = write_pages(out, grades, sources_of(results), left_out=collection.refused)
    tell_the_end(console, grades, unentered, out, page)
    not_graded = _tell_what_is_left(console, collection, results)
    raise typer.Exit(COULD_NOT if unentered or not_graded or collection.refused else 0)


def _grade_all(
    console: Console,
    collection: Collection,
    out: Path,
    isolation: Isolation,
    jobs: int,
    seeds: Seeds,
    resume: bool,
    workers: Workers | None,
) -> list[Graded]:
    """Grade in parallel and return the results in the order of the submissions."""
    with bar(console) as progress:
        task = progress.add_task("checks", total=None)
        runner = BatchRunner(
            GradeCache(out / "cache", isolation),
            isolation,
            jobs=jobs,
            seeds=seeds,
            resume=resume,
            workers=workers,
            report=lambda verdict: progress.advance(task),
            drawings=Drawings(out),
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


def _tell_what_is_left(console: Console, collection: Collection, results: Sequence[Graded]) -> int:
    """Name what has no grade; return how many submissions the grader failed to judge."""
    for line in collection.ignored:
        console.print(f"left aside: {line}", style="yellow", markup=False)
    for line in collection.refused:
        console.print(f"not graded: {line}", style="red", markup=False)
    not_graded = sum(result.grade.status == "not graded" for result in results)
    if not_graded:
        console.print(f"{not_graded} not graded; try those again with --resume", style="magenta")
    return not_graded
