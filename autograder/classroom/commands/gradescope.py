"""`course gradescope`: grades an upload; run_autograder calls this command in Gradescope's container."""

from __future__ import annotations

import traceback
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.on_gradescope.container import CannotGrade, Container, isolation_here
from ros_runtime.course_error import COMMAND_FAILED, CommandFailed
from ros_runtime.project import PROJECT


def gradescope(
    root: Annotated[Path, typer.Option(help="the folder with submission/ and results/")] = Path(
        "/autograder"
    ),
    exercise: Annotated[
        str, typer.Option(help="the assignment's exercise (default: the exercise whose file was uploaded)")
    ] = "",
) -> None:
    """Grade the upload in a Gradescope container with the visible checks, and write results.json.

    If the container cannot grade, results.json has no score, and the exit status is 1.
    """
    console = Console(highlight=False)
    from autograder.classroom.on_gradescope.grading import WITHOUT_SCORE, grade_upload

    container = Container(root)
    container.remove_results()
    try:
        container.restrict_to_root(PROJECT / "checks")
        isolation = isolation_here()
        console.print(f"isolation: {isolation.label} ({isolation.reason})", markup=False)
        results = grade_upload(container, exercise, isolation)
    except CannotGrade as error:
        container.write(WITHOUT_SCORE)
        raise CommandFailed(f"not graded: {error}") from error
    except Exception as error:  # any other error is the grader's fault, not the student's
        container.write(WITHOUT_SCORE)
        traceback.print_exc()
        raise typer.Exit(COMMAND_FAILED) from error
    container.write(results)
    console.print(
        f"{container.results}: {'no score' if results.score is None else f'{results.score:g} points'}"
    )
    raise typer.Exit(COMMAND_FAILED if results.score is None else 0)
