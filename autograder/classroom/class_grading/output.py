"""Prints the results of grading a class: the table, the submissions without a grade, and the paths of the files."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from autograder.classroom.batch.batch_record import BatchRecord
from autograder.classroom.batch.collection import Collection, Work
from autograder.classroom.batch.records import GRADES
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.version import checks_version
from autograder.classroom.class_grading.class_files import ClassFiles
from autograder.engine.exercise import exercises_folder
from autograder.recording.kept import FOLDER as RECORDINGS
from autograder.report.console import BAD, NOTICE, OTHER
from autograder.report.table import class_table


def add_all(console: Console, files: ClassFiles, results: Sequence[Graded]) -> None:
    """Add results to the files of a class; nbgrader is slow, so a progress bar is shown."""
    if not results:
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(elapsed_when_finished=True),
    )
    with Progress(*columns, console=console) as progress:
        for result in progress.track(results, description="gradebook"):
            files.add(result)


def print_changed_checks(console: Console, before: BatchRecord, works: Sequence[Work]) -> None:
    """Print for which exercises a resumed batch keeps no grade, because their checks or the engine have changed."""
    changed = {
        row.exercise
        for row in before.rows
        if row.version != checks_version(exercises_folder() / row.exercise)
    } & {work.exercise for work in works}
    if changed:
        console.print(
            f"the checks or the engine have changed, so these are graded again: {', '.join(sorted(changed))}; "
            "--exercise NAME grades only another exercise, and keeps these grades",
            style=NOTICE,
            markup=False,
        )


def print_problems(console: Console, files: ClassFiles) -> bool:
    """Print the grades that are not in the gradebook; return whether all grades are in it."""
    problems = files.problems()
    for line in problems:
        console.print(f"not in the gradebook: {line}", style=BAD, markup=False)
    return not problems


def print_summary(console: Console, files: ClassFiles, out: Path, page: Path) -> bool:
    """Print the table of the class and the paths of the results; return whether the gradebook has all grades."""
    console.print(class_table(files.grades))
    is_entered = print_problems(console, files)
    if to_mark := sum(grade.status == "to mark" for grade in files.grades):
        console.print(
            f"{to_mark} to be marked by hand, in formgrader; then run this command again with --resume to write the "
            f"points to {GRADES}",
            style=OTHER,
        )
    for line in files.deadline_notes:
        console.print(line, style="dim", markup=False, soft_wrap=True)
    console.print(f"read this first: {page}", markup=False, soft_wrap=True)
    console.print(f"{out / GRADES}, {out / 'gradebook.db'}, {out / 'feedback'}/", style="dim", markup=False)
    jupyter = Path(sys.executable).with_name("jupyter")
    console.print(
        f"open them in nbgrader: cd {out} && {jupyter} lab, then Nbgrader > Formgrader", style="dim"
    )
    return is_entered


def print_recordings(console: Console, out: Path, results: Sequence[Graded]) -> None:
    """Print where the recordings are, and how many grades have none."""
    console.print(
        f"recordings: {out / RECORDINGS}/<student>/<exercise>/<scenario>.mcap, hidden checks included; show one: "
        "./course replay FILE",
        style="dim",
        markup=False,
    )
    if cached := sum(result.cached for result in results):
        console.print(
            f"{cached} grades are from an earlier run and have no new recording; to record them, grade again without "
            "--resume, with the --seed in batch.json",
            style=NOTICE,
        )


def left_aside(collection: Collection, results: Iterable[Graded]) -> list[str]:
    """Return a sentence on each file or folder that was handed in and is not graded."""
    return [*collection.ignored, *(line for result in results for line in result.work.left_aside)]


def print_ungraded(console: Console, collection: Collection, results: Iterable[Graded]) -> int:
    """Print the files and folders without a grade; return the number of submissions that the grader failed to judge."""
    results = list(results)
    for line in left_aside(collection, results):
        console.print(f"left aside: {line}", style=NOTICE, markup=False)
    for line in collection.refused:
        console.print(f"not graded: {line}", style=BAD, markup=False)
    not_graded = sum(result.grade.status == "not graded" for result in results)
    if not_graded:
        console.print(
            f"{not_graded} not graded; grade them again with --resume --jobs 1, when the machine is less busy",
            style=NOTICE,
        )
    return not_graded
