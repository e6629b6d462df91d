"""`course bench`: measures times and processor times on this machine."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.engine.exercise import exercise_names, load_exercise
from course_cli.options import JobsOption
from ros_runtime.course_error import CourseError

ALL = "all"


def bench(
    arena: Annotated[
        bool, typer.Option("--arena", help="measure only the cost of one arena, by phase")
    ] = False,
    submission: Annotated[
        list[str] | None,
        typer.Option(
            help="measure only the cost of grading this exercise's reference solution (can be repeated, or 'all')"
        ),
    ] = None,
    against: Annotated[
        Path | None,
        typer.Option(exists=True, dir_okay=False, help="compare with a file that --json wrote"),
    ] = None,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="write the costs of arenas and gradings to this file")
    ] = None,
    runs: Annotated[
        int,
        typer.Option(
            min=1, help="how often each walk, arena and grading is measured; the best result counts"
        ),
    ] = 5,
    scale: Annotated[
        list[float] | None, typer.Option(help="clock scale in the table's rows on fairness (can be repeated)")
    ] = None,
    jobs: JobsOption = 2,
    robot: Annotated[bool, typer.Option(help="also run the robot's quick trials")] = True,
    trial: Annotated[
        list[str] | None,
        typer.Option(help="run only this trial of the robot, with all its runs (can be repeated, or 'all')"),
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="with --trial: a few runs of each")] = False,
) -> None:
    """Print the performance table."""
    from bench.arena.tables import bench_arenas
    from bench.overview import bench_overview
    from bench.robot.table import bench_robot

    console = Console()
    if against and not (arena or submission):
        raise CourseError("--against needs --arena or --submission")
    if json_file and not (arena or submission):
        raise CourseError("--json needs --arena or --submission")
    if not (arena or submission or trial):
        bench_overview(console, runs=runs, scales=scale or [], jobs=jobs, with_robot=robot)
        return
    try:
        if arena or submission:
            bench_arenas(
                console,
                arenas=arena,
                submissions=_exercises(submission or []),
                against=against,
                json_file=json_file,
                runs=runs,
                jobs=jobs,
            )
        elif trial:
            bench_robot(console, None if ALL in trial else trial, quick=quick, jobs=jobs)
    except ValueError as error:
        raise CourseError(str(error)) from error


def _exercises(names: list[str]) -> list[str]:
    """Return the exercises that the options name; raises `UnknownExercise` if one does not exist."""
    chosen = exercise_names() if ALL in names else names
    for name in chosen:
        load_exercise(name, hidden=False)
    return chosen
