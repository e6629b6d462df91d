"""`course check`: students check their own work, with the visible checks and the grader's engine."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.engine.essay import load_essay
from autograder.engine.exercise import essay_names, exercise_names, scenario_file
from autograder.engine.submission import UnusableSubmission, read_submission
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.report.console import NOTICE, LineConsole
from course_cli.options import CourseOption, JobsOption
from course_cli.own_work import own_work
from ros_runtime.course_error import COMMAND_FAILED, NOT_GRADED
from ros_runtime.terminal import as_typed


def check(
    exercise: Annotated[str, typer.Argument(metavar="EXERCISE", help="such as battery_service")],
    file: Annotated[
        Path | None,
        typer.Argument(
            metavar="FILE",
            help="your .py file, notebook or folder (default: your latest file here, else in exercises/EXERCISE/)",
        ),
    ] = None,
    json_file: Annotated[
        Path | None,
        typer.Option(
            "--json",
            metavar="FILE",
            help="also write the verdicts to this file, for programs",
            dir_okay=False,
        ),
    ] = None,
    record: Annotated[
        bool,
        typer.Option("--record", help="record what happens, in recordings/EXERCISE/, for `course replay`"),
    ] = False,
    page: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.html", help="write a page to show: task, program, points, a film of the robot"
        ),
    ] = None,
    robot: Annotated[
        str | None,
        typer.Option(
            metavar="g1",
            help="an extra without points: check a walking program on the robot G1 (docs/robot.md)",
        ),
    ] = None,
    jobs: JobsOption = 2,
    course: CourseOption = None,
) -> None:
    """Run the visible checks of an exercise on your own program, and say what to mend."""
    console = LineConsole()
    path, left_aside = own_work(exercise, file)
    for line in left_aside:
        console.print(f"left aside: {line}", style=NOTICE, markup=False)
    if robot and page:
        raise UnusableSubmission(
            "--page shows points, and a check on another robot gives none: leave --page or --robot out"
        )
    if exercise in essay_names():
        if page:
            raise UnusableSubmission(f"{exercise} has no page: a person marks it, so no run can be shown")
        _show_rubric(console, exercise, path)
        return
    with SubmissionArenas(scenario_file(exercise)) as arenas:
        if exercise in exercise_names() and path.exists():
            arenas.open_ahead()
        # The import runs while the arena opens, so that the first verdict comes sooner.
        from autograder.self_check import check_and_keep, print_next_step

        folder = Path("recordings") / exercise if record else None
        result = check_and_keep(
            console, path, exercise, jobs=jobs, arenas=arenas, recordings=folder, page=page, robot=robot
        )
    if not robot:
        print_next_step(console, result, path, file=file)
    if json_file:
        json_file.write_text(json.dumps(result.to_json(), indent=2) + "\n")
    if result.status == "not graded":
        console.print(
            f"Next: {as_typed(f'check {exercise} --jobs 1')}, when the machine is less busy.", markup=False
        )
        raise typer.Exit(NOT_GRADED)
    raise typer.Exit(0 if result.all_passed else COMMAND_FAILED)


def _show_rubric(console: Console, exercise: str, path: Path) -> None:
    """Print that the file can be read, and the criteria for a person's marks."""
    read_submission(path, exercise)
    console.print(f"{path} can be read. A person marks {exercise}, so nothing is checked here:", markup=False)
    for criterion in load_essay(exercise).criteria:
        console.print(f"  {criterion.title}: {criterion.points} points", markup=False)
