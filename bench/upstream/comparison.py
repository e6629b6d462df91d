"""Which tests pass with rclpy as it is, and do not with what the course changes."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from bench.upstream.modes import PLAIN, Mode
from bench.upstream.runs import NOT_RUN, FileRun, run_file

# They count ticks of 10 and 1 ms. On a clock that runs five times as fast the kernel is five times as late, and no
# exercise has such a period.
TOO_FINE = re.compile(r"test_timer\.py::\w+\[0\.0\d+\]")
ALONE = 3  # further runs of the tests of a file that did not pass, with nothing beside them


@dataclass(frozen=True)
class Difference:
    """A test that passes plain and, in one mode, never did."""

    file: str
    test: str
    mode: Mode
    outcome: str
    why: str

    @property
    def too_fine(self) -> bool:
        """Whether it measures what a clock that is sped up cannot give."""
        fast = self.mode.scale is not None and self.mode.scale > 1.0
        return fast and bool(TOO_FINE.fullmatch(f"{self.file}::{self.test}"))


@dataclass(frozen=True)
class Comparison:
    """All runs, and what differs."""

    runs: list[FileRun]
    differences: list[Difference]

    @property
    def faults(self) -> list[Difference]:
        """What the course has spoilt."""
        return [one for one in self.differences if not one.too_fine]

    def to_json(self) -> dict[str, Any]:
        """The whole, for `--json`."""
        runs = [
            {
                "file": run.file,
                "mode": run.mode.name,
                **{outcome: run.number(outcome) for outcome in ("passed", "failed", "skipped")},
                "not_run": run.number(NOT_RUN),
                "ended": run.ended,
                "wall_s": round(run.wall_s, 2),
                "tests": run.outcomes,
                "passed_alone": run.passed_alone,
            }
            for run in self.runs
        ]
        differences = [
            {
                "file": one.file,
                "test": one.test,
                "mode": one.mode.name,
                "outcome": one.outcome,
                "too_fine": one.too_fine,
                "why": one.why,
            }
            for one in self.differences
        ]
        return {"rclpy": rclpy_version(), "files": runs, "differences": differences}


def compare(
    files: Sequence[Path], modes: Sequence[Mode], jobs: int, progress: Callable[[FileRun], None]
) -> Comparison:
    """Run every file in every mode, `jobs` at a time; what did not pass runs again, alone."""

    def run(one: tuple[Path, Mode]) -> FileRun:
        done = run_file(*one)
        progress(done)
        return done

    with ThreadPoolExecutor(jobs) as pool:
        beside_others = list(pool.map(run, [(file, mode) for file in files for mode in modes]))
    paths = {file.name: file for file in files}
    runs = [_settled(paths[run.file], run) for run in beside_others]
    return Comparison(runs, differing(runs))


def differing(runs: Sequence[FileRun]) -> list[Difference]:
    """The tests that passed plain, and did not in another mode."""
    plain = {run.file: run.outcomes for run in runs if run.mode == PLAIN}
    return [
        Difference(run.file, test, run.mode, outcome, run.reasons.get(test, run.ended or ""))
        for run in runs
        if run.mode != PLAIN
        for test, before in plain.get(run.file, {}).items()
        if before == "passed" and (outcome := run.outcomes.get(test, NOT_RUN)) != "passed"
    ]


def _settled(path: Path, run: FileRun) -> FileRun:
    """The run, with how its failed tests went alone: the tests have deadlines, and the machine has other work."""
    outcomes, alone = dict(run.outcomes), []
    for _ in range(ALONE):
        failed = [test for test, outcome in outcomes.items() if outcome in ("failed", NOT_RUN)]
        if not failed:
            break
        again = run_file(path, run.mode, failed).outcomes
        passed = [test for test in failed if again.get(test) == "passed"]
        outcomes.update(dict.fromkeys(passed, "passed"))
        alone += passed
    return FileRun(run.file, run.mode, outcomes, run.reasons, run.wall_s, run.ended, alone)


def rclpy_version() -> str:
    """The version of rclpy that was tested; "unknown" where it has no metadata."""
    for name in ("ros-rclpy", "rclpy"):
        try:
            return version(name)
        except PackageNotFoundError:
            continue
    return "unknown"
