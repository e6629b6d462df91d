"""The table of `course bench --checks-of`: the time of each check of an exercise."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from autograder.engine.clock_scale import highest_scale
from autograder.engine.exercise import load_exercise
from autograder.engine.submission import read_submission
from autograder.isolation.availability import available_isolation
from bench.arena.check_costs import ArenaCost, cost_of_checks, total
from ros_runtime.project import PROJECT


def bench_checks(console: Console, name: str, jobs: int) -> None:
    """Run each scenario of an exercise once with its reference, and print what the checks cost.

    Raises:
        UnknownExercise: there is no exercise of this name.
    """
    exercise = load_exercise(name, hidden=available_isolation().trusted)
    reference = read_submission(PROJECT / "solutions" / name / f"{name}.ipynb", name)
    with Progress(console=console, transient=True) as progress:
        task = progress.add_task(f"{name}: one arena for each scenario", total=None)
        cost = cost_of_checks(
            reference,
            exercise,
            scale=highest_scale(),
            jobs=jobs,
            progress=lambda _scenario: progress.advance(task),
        )
    table = Table(
        title=f"The checks of {name} and their arenas, with the reference, {jobs} at a time",
        caption="An arena that several checks judge is counted at each of them, and once in the last row.",
    )
    table.add_column("check")
    for heading in ("points", "arenas", "arena's clock s", "wall s"):
        table.add_column(heading, justify="right")
    for row in cost.checks:
        table.add_row(row.check.id, str(row.check.points), *_arenas(row.arenas))
    table.add_section()
    table.add_row("all", str(exercise.max_score()), *_arenas(cost.arenas))
    console.print(table)


def _arenas(arenas: Sequence[ArenaCost]) -> tuple[str, str, str]:
    """Return the cells with the number of arenas and what they cost."""
    cost = total(arenas)
    return str(len(arenas)), f"{cost.clock:.1f}", f"{cost.wall:.1f}"
