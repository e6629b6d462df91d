"""`course rehearse`: a made-up class, whose grades are known, to try grading at the size of yours."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.audit.classroom import GRADED, LABELS, SUBMITTED, CannotRehearse, make_class, surprises
from autograder.audit.known_essay import known_essays
from autograder.audit.known_submission import known_submissions
from autograder.engine.essay import load_essay
from autograder.engine.exercise import (
    UnknownExercise,
    UnusableExercise,
    essay_names,
    exercise_names,
    load_exercise,
)
from course_cli.ending import COULD_NOT, UNUSABLE, ended
from course_cli.exercises_option import CourseOption

rehearse = typer.Typer(help="Make a class whose grades are known, and compare them after `course grade`.")
FolderArgument = Annotated[Path, typer.Argument(help="folder of the class")]


@rehearse.command()
def make(
    folder: FolderArgument,
    students: Annotated[int, typer.Option(min=1, help="how many students")] = 30,
    exercise: Annotated[
        list[str] | None, typer.Option("--exercise", help="an exercise; repeat it for several (default: all)")
    ] = None,
    seed: Annotated[int, typer.Option(help="the same seed makes the same class")] = 0,
    course: CourseOption = None,
) -> None:
    """Write the submissions of a class: 70 % correct, 20 % faulty, 10 % hostile, drawn from the known ones.

    Of an essay, students hand in its solution or an answer that is marked for comparison; it waits for a person.
    """
    console = Console(highlight=False)
    programs = [name for name in exercise_names() if known_submissions(name)]
    exercises = exercise or [*programs, *(name for name in essay_names() if known_essays(name))]
    try:
        for name in exercises:
            if name in essay_names():
                load_essay(name)
            else:
                load_exercise(name, hidden=False)
        make_class(folder, exercises, students, seed=seed)
    except (CannotRehearse, UnknownExercise, UnusableExercise) as error:
        raise ended(console, error, UNUSABLE) from error
    console.print(
        f"{students * len(exercises)} submissions in {folder / SUBMITTED}, labelled in {folder / LABELS}."
    )
    also = f" --course {course}" if course else ""
    console.print(
        f"Next: ./course grade {folder / SUBMITTED} --out {folder / GRADED}{also}, then ./course rehearse compare "
        f"{folder}{also}",
        soft_wrap=True,
    )


@rehearse.command()
def compare(folder: FolderArgument, course: CourseOption = None) -> None:
    """Compare the grades with what is known; exit status 0 only if every verdict is as known."""
    console = Console(highlight=False)
    try:
        found = surprises(folder)
    except CannotRehearse as error:
        raise ended(console, error, UNUSABLE) from error
    for whose, words in found.items():
        console.print(whose, style="red", markup=False)
        for line in words:
            console.print(f"    {line}", markup=False)
    labels = json.loads((folder / LABELS).read_text())
    console.print(f"{sum(map(len, labels.values()))} submissions, {len(found)} not as known")
    raise typer.Exit(COULD_NOT if found else 0)
