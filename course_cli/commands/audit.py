"""`course audit`: does every check catch what it should, and does no sound submission fail?"""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.audit.kill_matrix import kill_matrix, print_progress
from autograder.audit.known_submission import HeaderError, known_submissions
from autograder.audit.run import AuditedRun
from autograder.audit.run import audit as run_audit
from autograder.exercise import UnknownExercise, UnusableExercise, exercise_names, load_exercise
from autograder.grading import HiddenChecksRefused
from course_cli.ending import COULD_NOT, UNUSABLE, ended
from course_cli.exercises_option import CourseOption

MATRIX_WIDTH = 140


def audit(
    exercise: Annotated[str | None, typer.Argument(help="the exercise (default: all of them)")] = None,
    jobs: Annotated[int, typer.Option(min=1, help="arenas at a time; one a core")] = 2,
    repeat: Annotated[int, typer.Option(min=1, help="times, each with other inputs for the scenarios")] = 1,
    only: Annotated[str, typer.Option(help="only submissions whose name matches, such as 'faulty/*'")] = "*",
    scale: Annotated[float | None, typer.Option(help="how much faster the arenas' clock runs")] = None,
    json_file: Annotated[Path | None, typer.Option("--json", help="write every verdict to this file")] = None,
    course: CourseOption = None,
) -> None:
    """Grade submissions whose faults are known; exit 0 only when every verdict is the right one."""
    console = Console(highlight=False)
    audited: dict[str, list[AuditedRun]] = {}
    try:
        for name in [exercise] if exercise else exercise_names():
            loaded = load_exercise(name, hidden=True)
            runs = run_audit(
                known_submissions(name, only=only),
                loaded,
                jobs=jobs,
                repeat=repeat,
                scale=scale,
                report=lambda run: print_progress(console, run),
            )
            console.print()
            console.print(kill_matrix(runs, loaded), width=max(console.width, MATRIX_WIDTH))
            console.print()
            audited[name] = runs
    except (UnknownExercise, UnusableExercise, HeaderError) as error:
        raise ended(console, error, UNUSABLE) from error
    except HiddenChecksRefused as error:
        raise ended(console, error, COULD_NOT) from error
    if json_file:
        record = {name: [run.to_json() for run in runs] for name, runs in audited.items()}
        json_file.write_text(json.dumps(record, indent=2) + "\n")
    every_run = [run for runs in audited.values() for run in runs]
    if not every_run:
        raise ended(console, f"no submission matches {only!r}", UNUSABLE)
    raise typer.Exit(COULD_NOT if any(run.surprises() for run in every_run) else 0)
