"""`course check`: students check their own work, with the visible checks and the engine that grades."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.engine.essay import load_essay
from autograder.engine.exercise import (
    UnknownExercise,
    UnusableExercise,
    essay_names,
    exercise_names,
    file_names,
    scenario_file,
)
from autograder.engine.submission import UnusableSubmission, place_of_work, read_submission
from autograder.engine.submission_arenas import SubmissionArenas
from course_cli.ending import COULD_NOT, UNUSABLE, ended
from course_cli.exercises_option import CourseOption
from course_cli.jobs_option import JobsOption


def check(
    exercise: Annotated[str, typer.Argument(help="the exercise, such as battery_service")],
    file: Annotated[
        Path | None,
        typer.Argument(
            help="your .py file or notebook (default: EXERCISE.py here, else exercises/EXERCISE/)"
        ),
    ] = None,
    json_file: Annotated[Path | None, typer.Option("--json", help="write the verdicts to this file")] = None,
    record: Annotated[
        bool,
        typer.Option("--record", help="keep an MCAP file of each scenario in recordings/EXERCISE/"),
    ] = False,
    jobs: JobsOption = 2,
    course: CourseOption = None,
) -> None:
    """Check your own solution of an exercise."""
    console = Console(highlight=False)
    try:
        path = file or _default_file(exercise)
        if exercise in essay_names():
            _show_rubric(console, exercise, path)
            return
        with SubmissionArenas(scenario_file(exercise)) as arenas:
            if exercise in exercise_names() and path.exists():
                arenas.open_ahead()
            # imported meanwhile, because the first verdict is waited for
            from autograder.self_check import check_and_keep

            folder = Path("recordings") / exercise if record else None
            result = check_and_keep(console, path, exercise, jobs=jobs, arenas=arenas, recordings=folder)
    except (UnknownExercise, UnusableExercise, UnusableSubmission) as error:
        raise ended(console, error, UNUSABLE) from error
    if json_file:
        json_file.write_text(json.dumps(result.to_json(), indent=2) + "\n")
    raise typer.Exit(0 if result.all_passed else COULD_NOT)


def _show_rubric(console: Console, exercise: str, path: Path) -> None:
    """Say that the work can be read, and by what a person will mark it."""
    read_submission(path, exercise)
    console.print(f"{path} can be read. A person marks {exercise}, so nothing is checked here:", markup=False)
    for criterion in load_essay(exercise).criteria:
        console.print(f"  {criterion.title}: {criterion.points} points", markup=False)


def _default_file(exercise: str) -> Path:
    """Return the first existing file of the places where a student's work may be."""
    if written := place_of_work(exercise, Path()):
        return written
    notebooks = [Path("exercises") / exercise / f"{exercise}.ipynb", Path(f"{exercise}.ipynb")]
    for notebook in notebooks:
        if notebook.exists():
            return notebook
    looked_for = ", ".join([*file_names(exercise), *map(str, notebooks)])
    raise UnusableSubmission(f"found none of {looked_for}; name your file: ./course check {exercise} FILE")
