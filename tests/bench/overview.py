"""The tables of `course bench`: waiting times, fairness of the arenas, and the cost of the live picture."""

from __future__ import annotations

import io
import subprocess
import time
from collections.abc import Callable, Sequence
from contextlib import redirect_stdout

from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from autograder.classroom.audit.known_submission import known_submission
from autograder.engine.arena_run import ArenaRun, run_in_arena
from autograder.engine.clock_scale import highest_scale
from autograder.engine.exercise import Exercise, load_exercise
from autograder.engine.grading import GradingOptions, Watcher, grade
from autograder.engine.submission import Submission
from autograder.engine.verdict import CheckVerdict
from autograder.isolation.availability import available_isolation
from bench.arena.fairness import FairRun, fairness_runs
from bench.robot import run_trials
from bench.robot.table import table_of
from bench.view_cost import view_cost
from ros_runtime.project import PROJECT
from ros_runtime.workarounds.gl_backend import NoOpenGLError

EXERCISE = "cancellable_walk"
THREADED = "correct/threads_and_sleep"  # the correct server that must pass on every machine


def bench_overview(
    console: Console, *, runs: int, scales: Sequence[float], jobs: int, with_robot: bool
) -> None:
    """Measure everything once and print each table as soon as it is complete.

    Args:
        console: where to print.
        runs: how often the correct server walks at each scale.
        scales: of the arena's clock; none: real time and the highest one.
        jobs: how many arenas run at a time.
        with_robot: whether the robot's quick trials run, too.
    """
    exercise = load_exercise(EXERCISE, hidden=available_isolation().trusted)
    threaded = known_submission(EXERCISE, THREADED).read()
    console.print(_costs(exercise, threaded, jobs))
    _print_fairness(console, exercise, threaded, runs, scales or [1.0, highest_scale()], jobs)
    console.print(_live_picture(console))
    if with_robot:
        with console.status("the robot's quick trials …"):
            rows = run_trials(quick=True, jobs=jobs)
        console.print(table_of(rows))


def _costs(exercise: Exercise, submission: Submission, jobs: int) -> Table:
    table = Table(title="What things cost (wall time, this run)")
    table.add_column("")
    table.add_column("seconds", justify="right")
    table.add_row("the launcher's own part of a second run", f"{_launcher_seconds():.2f}")
    shortest = exercise.checks[0].on[0]
    run = ArenaRun(exercise, submission.files, shortest, 0, highest_scale())
    table.add_row(
        f"one arena, from start to end (for check {exercise.checks[0].id})",
        f"{_seconds(lambda: run_in_arena(run)):.2f}",
    )
    seconds = _seconds_of_verdicts(submission, load_exercise(EXERCISE, hidden=False), jobs)
    table.add_row(f"course check {EXERCISE}: first verdict", f"{seconds[0]:.1f}")
    table.add_row(f"course check {EXERCISE}: all {len(seconds)} verdicts", f"{seconds[-1]:.1f}")
    seconds = _seconds_of_verdicts(submission, exercise, jobs)
    table.add_row(f"grading {EXERCISE}: all {len(seconds)} verdicts", f"{seconds[-1]:.1f}")
    return table


def _launcher_seconds() -> float:
    console_script = _seconds(lambda: _quietly(str(PROJECT / ".venv" / "bin" / "course"), "--help"))
    launcher = _seconds(lambda: _quietly(str(PROJECT / "course"), "--help"))
    return launcher - console_script


def _seconds_of_verdicts(submission: Submission, exercise: Exercise, jobs: int) -> list[float]:
    """Grade once and return the time of each verdict (s from the start)."""
    seconds: list[float] = []
    started = time.monotonic()

    def note(_verdict: CheckVerdict) -> None:
        seconds.append(time.monotonic() - started)

    grade(submission, exercise, GradingOptions(jobs=jobs), Watcher(note))
    return seconds


def _print_fairness(
    console: Console,
    exercise: Exercise,
    submission: Submission,
    runs: int,
    scales: Sequence[float],
    jobs: int,
) -> None:
    walk = next(check.on[0] for check in exercise.checks if check.id == "arrives")
    table = Table(title="The same sound MultiThreadedExecutor walk server, again and again")
    for heading in ("scale", "fair", "feedback Hz", "largest gap s", "simulator late s"):
        table.add_column(heading, justify="right")
    failures = []
    with Progress(console=console, transient=True) as progress:
        for scale in scales:
            task = progress.add_task(f"walks at scale {scale:g}", total=runs)
            results = fairness_runs(
                submission,
                exercise,
                walk,
                runs=runs,
                scale=scale,
                jobs=jobs,
                progress=lambda _run, task=task: progress.advance(task),  # type: ignore[misc]
            )
            table.add_row(f"{scale:g}", *_fairness_cells(results))
            failures += [f"scale {scale:g}: {failure}" for run in results for failure in run.failed]
    console.print(table)
    for failure in failures:
        console.print(failure, markup=False)


def _fairness_cells(results: Sequence[FairRun]) -> tuple[str, str, str, str]:
    rates = [run.rate for run in results]
    return (
        f"{sum(run.fair for run in results)}/{len(results)}",
        f"{min(rates):.2f}–{max(rates):.2f}",
        f"{max(run.gap for run in results):.2f}",
        f"{max(run.lag for run in results):.2f}",
    )


def _live_picture(console: Console) -> Table | str:
    """Return the rate and cost of `lab.watch_robot()`, or why there is no picture."""
    try:
        with console.status("a robot is watched while it walks …"), redirect_stdout(io.StringIO()):
            cost = view_cost()
    except NoOpenGLError as error:
        return f"The live picture in a notebook was not measured. {error}"
    table = Table(title="The live picture in a notebook, of a robot that walks")
    for heading in ("", "frames/s", "simulated s/s", "simulator, of a core", "notebook, of a core"):
        table.add_column(heading, justify="right" if heading else "left")
    rows = (("without", "", cost.without), ("with (asked: 10 to 15)", f"{cost.frames:.1f}", cost.watched))
    for name, frames, load in rows:
        table.add_row(
            name,
            frames,
            f"{load.pace:.3f}",
            f"{100 * load.simulator_share:.0f} %",
            f"{100 * load.notebook_share:.0f} %",
        )
    return table


def _seconds(action: Callable[[], object], repeats: int = 3) -> float:
    """Return the shortest of a few runs, because a machine's noise only adds time."""
    taken = []
    for _ in range(repeats):
        started = time.monotonic()
        action()
        taken.append(time.monotonic() - started)
    return min(taken)


def _quietly(*command: str) -> None:
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
