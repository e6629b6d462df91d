"""Functions for the commands that grade a class: fill the gradebook, and print the summary."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from autograder.classroom.batch.records import GRADES
from autograder.classroom.batch.runner import Graded
from autograder.classroom.class_grading.gradebook_writer import GradebookWriter
from autograder.engine.verdict import Grade
from autograder.recording.kept import FOLDER as RECORDINGS
from autograder.report.table import class_table


def enter_all(console: Console, results: Sequence[Graded], out: Path) -> tuple[list[str], list[Grade]]:
    """Enter the grades into nbgrader's gradebook one by one.

    Returns a sentence on each failed entry, and the grades with the points that a person gave in the gradebook.
    """
    writer = GradebookWriter(out)
    grades: list[Grade] = []
    with _bar(console) as progress:
        for result in progress.track(results, description="gradebook"):
            grades.append(writer.enter(result))
    return writer.problems(), grades


def sources_of(results: Sequence[Graded]) -> dict[tuple[str, str], Mapping[str, str] | None]:
    """Return the programs of these results, by student and exercise; None if a submission could not be read."""
    return {(result.work.student, result.work.exercise): result.sources for result in results}


def tell_the_end(
    console: Console, grades: Sequence[Grade], unentered: Sequence[str], out: Path, page: Path
) -> None:
    """Print the table of the class, the failed gradebook entries, and the paths of the results."""
    console.print(class_table(grades))
    for line in unentered:
        console.print(f"not in the gradebook: {line}", style="red", markup=False)
    to_mark = [grade for grade in grades if grade.status == "to mark"]
    if to_mark:
        console.print(
            f"{len(to_mark)} to be marked by hand, in formgrader; then run this again with --resume, and {GRADES} has "
            "the points",
            style="cyan",
        )
    console.print(f"to read first: {page}", markup=False, soft_wrap=True)
    console.print(f"{out / GRADES}, {out / 'gradebook.db'}, {out / 'feedback'}/", style="dim", markup=False)
    jupyter = Path(sys.executable).with_name("jupyter")
    console.print(
        f"to look at them in nbgrader: cd {out} && {jupyter} lab, then Nbgrader > Formgrader", style="dim"
    )


def tell_of_recordings(console: Console, out: Path, results: Sequence[Graded]) -> None:
    """Print where the recordings are, and how many grades have none."""
    console.print(
        f"recordings: {out / RECORDINGS}/<student>/<exercise>/<scenario>.mcap, hidden checks included; look at one: "
        "./course replay FILE",
        style="dim",
        markup=False,
    )
    cached = sum(result.cached for result in results)
    if cached:
        console.print(
            f"{cached} grades are from an earlier run, and nothing was recorded of them now; to record them, grade "
            "again without --resume, with the --seed that batch.json names",
            style="yellow",
        )


def _bar(console: Console) -> Progress:
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(elapsed_when_finished=True),
        console=console,
    )
