"""`course test`: the tests, all or by tier."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Collection, Sequence
from typing import Annotated

import typer

from ros_runtime.project import PROJECT

TIERS = ("fast", "arena", "robot", "browser")  # folders of tests/


def run_tests(
    context: typer.Context,
    fast: Annotated[
        bool,
        typer.Option("--fast", help="Units, without a sandbox, a robot process or a browser: one minute."),
    ] = False,
    arena: Annotated[
        bool,
        typer.Option("--arena", help="Sandboxes, submissions graded in them, gradebooks: half an hour."),
    ] = False,
    robot: Annotated[
        bool,
        typer.Option(
            "--robot",
            help="Robot processes, chapters and the lab in kernels, the demo: half an hour.",
        ),
    ] = False,
    browser: Annotated[
        bool, typer.Option("--browser", help="JupyterLab and the web view, seen in a browser: one minute.")
    ] = False,
) -> None:
    """Run the tests: all of them (45 minutes), or the tiers that are named.

    Further arguments go to pytest: `course test tests/fast/setup -x`, `course test --fast -k name`.
    """
    chosen = {tier for tier, wanted in zip(TIERS, (fast, arena, robot, browser), strict=True) if wanted}
    # In a child, because pytest's plugins and the ROS libraries both hold on to a process's state. Three files at a
    # time: robots and notebooks of the tests wait for the clock more than for the processors. The order of the files
    # is that of tests/conftest.py.
    command = [sys.executable, "-m", "pytest", "-n", "3", "--dist", "loadfile", "--no-loadscope-reorder"]
    status = subprocess.run([*command, *pytest_arguments(chosen, context.args)], cwd=PROJECT).returncode
    raise typer.Exit(0 if status == 0 else 1)


def pytest_arguments(tiers: Collection[str], further: Sequence[str]) -> list[str]:
    """Arguments with which pytest runs these tiers; without any tier, all."""
    others = [tier for tier in TIERS if tier not in tiers]
    if not tiers or not others:
        return list(further)
    # The markers would be enough, but importing the other tiers takes seconds.
    ignored = [f"--ignore=tests/{tier}" for tier in others]
    return [*ignored, "-m", " or ".join(sorted(tiers)), *further]
