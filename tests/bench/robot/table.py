"""The table of the robot's trials."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from rich.console import Console
from rich.table import Table

from bench.robot import run_trials
from bench.robot.trial import Summary


def bench_robot(console: Console, names: Iterable[str] | None, *, quick: bool, jobs: int) -> None:
    """Run trials, print their table and every run that failed.

    Args:
        console: where to print.
        names: keys of `TRIALS`; None for all.
        quick: a few runs of each instead of the full number.
        jobs: processes that share the runs.

    Raises:
        ValueError: a name is not known; the message lists the known ones.
    """
    rows = run_trials(names, quick=quick, jobs=jobs)
    console.print(table_of(rows))
    for row in rows:
        for failure in row.failures:
            console.print(f"{row.title}: {failure}", highlight=False, markup=False)


def table_of(rows: Sequence[Summary]) -> Table:
    """Lay the rows out as a table."""
    table = Table(title="The humanoid's trials")
    for heading in ("Trial", "Success", "Measured", "Reference", "CPU factor", "Met"):
        table.add_column(heading, justify="right" if heading in ("Success", "CPU factor") else "left")
    for row in rows:
        factor = "" if math.isnan(row.real_time_factor) else f"{row.real_time_factor:.0f}x"
        met = "[green]yes[/green]" if row.met else "[red]no[/red]"
        table.add_row(row.title, f"{row.successes}/{row.runs}", row.measured, row.reference, factor, met)
    return table
