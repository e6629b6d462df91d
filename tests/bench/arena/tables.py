"""The tables of `course bench --arena` and `--submission`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from rich import box
from rich.console import Console
from rich.table import Table

from bench.arena.arena_costs import ARENAS, ArenaCost, Costs, SubmissionCost, measure


def bench_arenas(
    console: Console,
    *,
    arenas: bool,
    submissions: Sequence[str],
    against: Path | None,
    json_file: Path | None,
    runs: int,
    jobs: int,
) -> None:
    """Measure, print, and write `json_file`; `against` is such a file of an earlier run.

    Raises:
        BenchFailed: a run failed.
        CannotBeMeasured: this machine cannot count processor time.
        ValueError: the file has another format.
    """
    other = Costs.from_json(json.loads(against.read_text())) if against else None
    with console.status("") as status:
        costs = measure(
            arenas=ARENAS if arenas else (),
            submissions=submissions,
            runs=runs,
            jobs=jobs,
            progress=lambda what: status.update(f"{what} …"),
        )
    if costs.arenas:
        console.print(_arenas_table(costs.arenas, other.arenas if other else ()))
        console.print(_phases_table(costs.arenas))
    if costs.submissions:
        console.print(_submissions_table(costs.submissions, other.submissions if other else (), jobs))
    if json_file:
        json_file.write_text(json.dumps(costs.to_json(), indent=2) + "\n")


def _arenas_table(arenas: Sequence[ArenaCost], others: Sequence[ArenaCost]) -> Table:
    table = _table(
        "One scenario in an open arena (best run); opening it comes on top, once a submission", others
    )
    for arena in arenas:
        other = next(
            (o for o in others if (o.exercise, o.scenario) == (arena.exercise, arena.scenario)), None
        )
        _add(table, f"{arena.exercise}\n{arena.scenario}", arena, other)
        if arena.opening.wall_s:
            opening = arena.opening
            table.add_row("  opening", f"{opening.cpu_s:.2f}", f"{opening.wall_s:.2f}", style="dim")
        if second := arena.robot_second_cpu_s:
            before = other.robot_second_cpu_s if other else None
            compared = ["", f"{before:.3f}", f"{second / before:.2f}"] if before else []
            table.add_row("  a robot second", f"{second:.3f}", "", *compared, style="dim")
    return table


def _submissions_table(
    graded: Sequence[SubmissionCost], others: Sequence[SubmissionCost], jobs: int
) -> Table:
    table = _table(f"A reference graded, hidden checks too, {jobs} arenas in parallel (best run)", others)
    for one in graded:
        _add(table, one.exercise, one, next((o for o in others if o.exercise == one.exercise), None))
    return table


def _phases_table(arenas: Sequence[ArenaCost]) -> Table:
    """Lay out the phases: first those of opening the arena."""
    table = Table(title="By phase: CPU s / wall s", box=box.SIMPLE_HEAD, padding=(0, 0))
    table.add_column("")
    for arena in arenas:
        table.add_column(f"{arena.exercise}\n{arena.scenario}", justify="right", overflow="fold")
    for name in dict.fromkeys(name for arena in arenas for name in arena.phases):
        phases = [arena.phases.get(name) for arena in arenas]
        table.add_row(name, *(f"{phase.cpu_s:.2f} / {phase.wall_s:.2f}" if phase else "" for phase in phases))
    return table


def _table(title: str, others: Sequence[object]) -> Table:
    table = Table(title=title)
    table.add_column("")
    compared = ("before:\nCPU / wall s", "ratio:\nCPU / wall") if others else ()
    for heading in ("CPU s", "wall s", "floor s", *compared):
        table.add_column(heading, justify="right")
    return table


def _add(
    table: Table, name: str, cost: ArenaCost | SubmissionCost, other: ArenaCost | SubmissionCost | None
) -> None:
    cells = [f"{cost.cpu_s:.2f}", f"{cost.wall_s:.2f}", f"{cost.floor_s:.2f}"]
    if other:
        cells.append(f"{other.cpu_s:.2f} / {other.wall_s:.2f}")
        cells.append(f"{cost.cpu_s / other.cpu_s:.2f} / {cost.wall_s / other.wall_s:.2f}")
    table.add_row(name, *cells)
