"""`course test`: runs all tests, or some tiers."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Annotated

import typer

from ros_runtime.project import PROJECT

TIERS = ("fast", "arena", "robot", "browser")  # folders of tests/
PYTEST_CACHE = Path(".pytest_cache/v")  # the values that pytest keeps between runs
LAST_FAILED = PYTEST_CACHE / "cache/lastfailed"  # the tests that failed in the last run, written by pytest
LOST_POINTS = "course/lost_points"  # key in pytest's cache: a correct submission that lost a point


def test(
    context: typer.Context,
    fast: Annotated[
        bool,
        typer.Option(
            "--fast", help="Unit tests, without a sandbox, a robot process or a browser: one minute."
        ),
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
            help="Run the failed tests once more, alone: with five test files in parallel, CI's machine is busy.",
        ),
    ] = False,
    browser: Annotated[
        bool, typer.Option("--browser", help="JupyterLab and the web view, seen in a browser: one minute.")
    ] = False,
) -> None:
    """Run the tests: all of them (half an hour), or the tiers that are named.

    Further arguments go to pytest: `course test tests/fast/setup -x`, `course test --fast -k name`.
    """
    chosen = {tier for tier, wanted in zip(TIERS, (fast, arena, robot, browser), strict=True) if wanted}
    # Five files in parallel, because robots and notebooks in the tests wait most of the time; unit tests do not.
    # tests/conftest.py sets the order of the files.
    workers = "auto" if chosen == {"fast"} else "5"
    parallel = ["-n", workers, "--dist", "loadfile", "--no-loadscope-reorder"]
    arguments = pytest_arguments(chosen, context.args)
    passed = run_pytest([*parallel, *arguments], PROJECT)
    if not passed and again:
        passed = pass_alone(arguments, PROJECT)
    raise typer.Exit(0 if passed else 1)


def run_pytest(arguments: Sequence[str], folder: Path) -> bool:
    """Run pytest in a child process, because its plugins and the ROS libraries change the state of their process."""
    (folder / PYTEST_CACHE / LOST_POINTS).unlink(missing_ok=True)
    return subprocess.run([sys.executable, "-m", "pytest", *arguments], cwd=folder).returncode == 0


def pass_alone(arguments: Sequence[str], folder: Path) -> bool:
    """Run the failed tests of the last run once more, one at a time; return whether all of them pass.

    A correct submission that lost a point remains a failure, because that must not happen even on a busy machine. A
    submission that could not be graded has lost no point.
    """
    record, lost = folder / LAST_FAILED, folder / PYTEST_CACHE / LOST_POINTS
    failed = sorted(json.loads(record.read_text())) if record.exists() else []
    if lost.exists():
        print(f"\na correct submission lost a point: {json.loads(lost.read_text())}", flush=True)
        return False
    if not failed:
        return False
    print(f"\n{len(failed)} failed in parallel and run again, alone:", *failed, sep="\n  ", flush=True)
    passed = run_pytest(["--last-failed", "--last-failed-no-failures=none", *arguments], folder)
    if passed:
        print(f"passed alone, and should pass on a busy machine, too: {', '.join(failed)}", flush=True)
    return passed


def pytest_arguments(tiers: Collection[str], further: Sequence[str]) -> list[str]:
    """Return the arguments with which pytest runs these tiers; without any tier, all tests."""
    others = [tier for tier in TIERS if tier not in tiers]
    if not tiers or not others:
        return list(further)
    # The markers would be enough, but importing the other tiers takes seconds.
    ignored = [f"--ignore=tests/{tier}" for tier in others]
    return [*ignored, "-m", " or ".join(sorted(tiers)), *further]
