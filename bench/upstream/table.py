"""The tables of `course bench --upstream`."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table

from bench.upstream.comparison import Comparison, Difference, compare, rclpy_version
from bench.upstream.modes import Mode, available_modes
from bench.upstream.runs import FileRun
from bench.upstream.source import COMMIT, copied_tests, downloaded_tests


def bench_upstream(console: Console, *, checkout: Path | None, json_file: Path | None, jobs: int) -> bool:
    """Run rclpy's tests, print the tables; returns whether all that passes plain passes with the course's changes.

    Args:
        console: where to print.
        checkout: of rclpy, with its tests; by default they are downloaded.
        json_file: where to write everything.
        jobs: how many files run at a time.

    Raises:
        NoTests: there are none.
    """
    changed: list[str] = []
    with tempfile.TemporaryDirectory() as copies, console.status("") as status:
        if checkout is None:
            folder = downloaded_tests(lambda what: status.update(f"{what} …"))
        else:
            folder, changed = copied_tests(checkout, Path(copies))
        files = sorted(folder.glob("test_*.py"))
        modes = available_modes()
        done: list[FileRun] = []

        def progress(run: FileRun) -> None:
            done.append(run)
            status.update(f"{len(done)} of {len(files) * len(modes)}: {run.file}, {run.mode.name} …")

        comparison = compare(files, modes, jobs, progress)
    if changed:
        console.print(f"Others than in commit {COMMIT[:10]}: {', '.join(changed)}", markup=False)
    console.print(_table(comparison, modes))
    for run in comparison.runs:
        if run.ended:
            console.print(f"{run.file}, {run.mode.name}: {run.ended}", markup=False)
    if comparison.differences:
        console.print(_differences(comparison.differences))
    console.print(_summary(comparison), markup=False)
    if json_file:
        json_file.write_text(json.dumps(comparison.to_json(), indent=2) + "\n", encoding="utf-8")
    return not comparison.faults


def _table(comparison: Comparison, modes: Sequence[Mode]) -> Table:
    table = Table(
        title=f"rclpy's own tests with rclpy {rclpy_version()}: passed / failed / skipped",
        caption="What fails beside other tests runs again, alone: that is what counts.",
    )
    table.add_column("", no_wrap=True)
    for mode in modes:
        table.add_column(mode.name, justify="right")
    runs = {(run.file, run.mode): run for run in comparison.runs}
    files = list(dict.fromkeys(run.file for run in comparison.runs))
    for file in files:
        table.add_row(file, *(_counts([runs[file, mode]]) for mode in modes))
    table.add_section()
    table.add_row("all", *(_counts([runs[file, mode] for file in files]) for mode in modes))
    return table


def _counts(runs: Sequence[FileRun]) -> str:
    numbers = [sum(run.number(outcome) for run in runs) for outcome in ("passed", "failed", "skipped")]
    not_run = sum(run.number("not run") for run in runs)
    return " / ".join(map(str, numbers)) + (f", {not_run} not run" if not_run else "")


def _differences(differences: Sequence[Difference]) -> Table:
    table = Table(title="They pass plain, and here not")
    for heading in ("test", "mode", "", ""):
        table.add_column(heading, overflow="fold")
    for one in differences:
        remark = "too fine for a fast clock" if one.too_fine else ""
        table.add_row(f"{one.file}::{one.test}", one.mode.name, one.outcome, remark)
    return table


def _summary(comparison: Comparison) -> str:
    if comparison.faults:
        number = len(comparison.faults)
        return f"The course spoils what works without it: {number} above. --json FILE has what pytest said."
    return (
        "All that passes plain passes with the course's repairs and on its clock, save what is named above."
    )
