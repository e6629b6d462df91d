"""`course test`: the tests, all or by tier."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Annotated

import typer

from ros_runtime.project import PROJECT

TIERS = ("fast", "arena", "robot", "browser")  # folders of tests/
SHOWN = 3000  # characters of each finding
KEPT = Path(".pytest_cache/v")  # by pytest
LAST_FAILED = KEPT / "cache/lastfailed"  # pytest's own record
LOST_POINTS = "course/lost_points"  # pytest's key of a correct submission that lost a point


def test(
    context: typer.Context,
    fast: Annotated[
        bool,
        typer.Option("--fast", help="Units, without a sandbox, a robot process or a browser: one minute."),
    ] = False,
    arena: Annotated[
        bool,
        typer.Option("--arena", help="Sandboxes, submissions graded in them, gradebooks: 20 minutes."),
    ] = False,
    robot: Annotated[
        bool,
        typer.Option(
            "--robot",
            help="Robot processes, chapters and the lab in kernels, the demo: 15 minutes.",
        ),
    ] = False,
    again: Annotated[
        bool,
        typer.Option(
            "--again",
            help="Run what failed once more, alone: CI's machine is busy with five files at a time.",
        ),
    ] = False,
    browser: Annotated[
        bool, typer.Option("--browser", help="JupyterLab and the web view, seen in a browser: one minute.")
    ] = False,
    fuzz: Annotated[
        float | None,
        typer.Option(
            "--fuzz",
            metavar="MINUTES",
            min=0,
            help="No tests: try what a student can send, made up from ever new seeds, so long; 0: one seed.",
        ),
    ] = None,
    fuzz_seed: Annotated[
        int | None,
        typer.Option("--fuzz-seed", min=0, help="With --fuzz: the first seed; else one of the time."),
    ] = None,
    fuzz_only: Annotated[
        list[str] | None,
        typer.Option("--fuzz-only", help="With --fuzz: only this fuzzer; repeat it for several."),
    ] = None,
) -> None:
    """Run the tests: all of them (half an hour), or the tiers that are named; or fuzz for some minutes.

    Further arguments go to pytest: `course test tests/fast/setup -x`, `course test --fast -k name`.
    """
    if fuzz is not None:
        raise typer.Exit(0 if run_fuzzers(fuzz, fuzz_seed, fuzz_only or []) else 1)
    chosen = {tier for tier, wanted in zip(TIERS, (fast, arena, robot, browser), strict=True) if wanted}
    # Five files at a time: robots and notebooks of the tests wait for the clock more than for the processors. The
    # order of the files is that of tests/conftest.py.
    parallel = ["-n", "5", "--dist", "loadfile", "--no-loadscope-reorder"]
    arguments = pytest_arguments(chosen, context.args)
    passed = run_pytest([*parallel, *arguments], PROJECT)
    if not passed and again:
        passed = pass_alone(arguments, PROJECT)
    raise typer.Exit(0 if passed else 1)


def run_fuzzers(minutes: float, seed: int | None, only: Sequence[str]) -> bool:
    """Fuzz, and return whether nothing was found."""
    from autograder.isolation.availability import available_isolation  # late: the tests need none of it
    from fuzz.arena.targets import TARGETS
    from fuzz.readers.all import READERS
    from fuzz.rounds import run_rounds

    if unknown := sorted(set(only) - {*READERS, *TARGETS}):
        raise typer.BadParameter(
            f"there is no fuzzer {unknown[0]}; there are {', '.join([*READERS, *TARGETS])}"
        )
    readers = [name for name in READERS if not only or name in only]
    targets = [name for name in TARGETS if not only or name in only]
    isolation = available_isolation()
    if targets and not isolation.trusted:
        print(f"No programs in arenas: {isolation.reason}", flush=True)
        targets = []
    seed = time.time_ns() // 1000 % 2**31 if seed is None else seed
    print(f"{len(readers) + len(targets)} fuzzers for {minutes:g} minutes from seed {seed} on", flush=True)
    rounds = run_rounds(minutes, seed, readers, targets, tell=lambda line: print(line, flush=True))
    for path in rounds.found:
        print(f"\n{path}\n{path.read_text(encoding='utf-8')[:SHOWN]}", flush=True)
    print(f"{rounds.count} seeds, {len(rounds.found)} findings", flush=True)
    return not rounds.found


def run_pytest(arguments: Sequence[str], folder: Path) -> bool:
    """Run pytest in a child, because its plugins and the ROS libraries both hold on to a process's state."""
    (folder / KEPT / LOST_POINTS).unlink(missing_ok=True)
    return subprocess.run([sys.executable, "-m", "pytest", *arguments], cwd=folder).returncode == 0


def pass_alone(arguments: Sequence[str], folder: Path) -> bool:
    """Run the tests that failed last once more, one at a time; return whether all of them pass then.

    A correct submission that lost a point stays a failure: that may not happen on a busy machine either. One that
    could not be graded there has lost none.
    """
    record, lost = folder / LAST_FAILED, folder / KEPT / LOST_POINTS
    failed = sorted(json.loads(record.read_text())) if record.exists() else []
    if lost.exists():
        print(f"\na correct submission lost a point: {json.loads(lost.read_text())}", flush=True)
        return False
    if not failed:
        return False
    print(f"\n{len(failed)} failed beside others and run again, alone:", *failed, sep="\n  ", flush=True)
    passed = run_pytest(["--last-failed", "--last-failed-no-failures=none", *arguments], folder)
    if passed:
        print(f"passed alone, and should pass on a busy machine, too: {', '.join(failed)}", flush=True)
    return passed


def pytest_arguments(tiers: Collection[str], further: Sequence[str]) -> list[str]:
    """Arguments with which pytest runs these tiers; without any tier, all."""
    others = [tier for tier in TIERS if tier not in tiers]
    if not tiers or not others:
        return list(further)
    # The markers would be enough, but importing the other tiers takes seconds.
    ignored = [f"--ignore=tests/{tier}" for tier in others]
    return [*ignored, "-m", " or ".join(sorted(tiers)), *further]
