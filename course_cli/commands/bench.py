"""`course bench`: times and processor times on this machine."""

from __future__ import annotations

import io
import subprocess
import time
from collections.abc import Callable, Sequence
from contextlib import redirect_stdout
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from autograder.audit.known_submission import known_submission
from autograder.bench.arena_costs import BenchFailed
from autograder.bench.check_costs import ArenaCost, cost_of_checks, total
from autograder.bench.fairness import fairness_runs
from autograder.bench.processor_time import CannotBeMeasured
from autograder.engine.arena_run import ArenaRun, run_in_arena
from autograder.engine.clock_scale import highest_scale
from autograder.engine.exercise import Exercise, UnknownExercise, exercise_names, load_exercise
from autograder.engine.grading import grade
from autograder.engine.submission import Submission, read_submission
from autograder.engine.verdict import CheckVerdict
from autograder.isolation.availability import available_isolation
from autograder.project import PROJECT
from course_cli.arena_bench import bench_arenas
from course_cli.ending import COULD_NOT, UNUSABLE, ended
from course_cli.jobs_option import JobsOption
from lab.view_cost import view_cost
from robot_sim.trials import run_trials
from robot_sim.trials.__main__ import table_of
from robot_sim.views.gl_backend import NoOpenGLError

EXERCISE = "cancellable_walk"
THREADED = "correct/threads_and_sleep"  # the sound server that every machine must treat fairly


def bench(
    arena: Annotated[
        bool, typer.Option("--arena", help="measure only the cost of one arena, by phase")
    ] = False,
    submission: Annotated[
        list[str] | None,
        typer.Option(
            help="measure only the cost of grading this exercise's reference (can be repeated, or 'all')"
        ),
    ] = None,
    against: Annotated[
        str | None,
        typer.Option(
            metavar="FILE|COMMIT",
            help="compare with a file that --json wrote, or with another commit, measured alternately",
        ),
    ] = None,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="write the costs of arenas to this file")
    ] = None,
    runs: Annotated[
        int,
        typer.Option(min=1, help="number of walks at each scale, arenas and gradings; the best run counts"),
    ] = 5,
    scale: Annotated[
        list[float] | None, typer.Option(help="clock scale of the fairness rows (can be repeated)")
    ] = None,
    jobs: JobsOption = 2,
    robot: Annotated[bool, typer.Option(help="also run the robot's quick trials")] = True,
    checks_of: Annotated[
        list[str] | None,
        typer.Option(help="measure only the time of each check of this exercise (can be repeated, or 'all')"),
    ] = None,
) -> None:
    """Print the performance table."""
    console = Console()
    if arena or submission:
        try:
            names = exercise_names() if "all" in (submission or ()) else submission or ()
            for name in names:
                load_exercise(name, hidden=False)
            bench_arenas(
                console,
                arenas=arena,
                submissions=names,
                against=against,
                json_file=json_file,
                runs=runs,
                jobs=jobs,
            )
        except (UnknownExercise, ValueError) as error:
            raise ended(console, error, UNUSABLE) from error
        except (BenchFailed, CannotBeMeasured) as error:
            raise ended(console, error, COULD_NOT) from error
        return
    if against or json_file:
        raise ended(console, "--against and --json go with --arena or --submission", UNUSABLE)
    if checks_of:
        try:
            for name in exercise_names() if "all" in checks_of else checks_of:
                console.print(_checks(console, name, jobs))
        except UnknownExercise as error:
            raise ended(console, error, UNUSABLE) from error
        return
    exercise = load_exercise(EXERCISE, hidden=available_isolation().trusted)
    threaded = known_submission(EXERCISE, THREADED).read()
    console.print(_costs(exercise, threaded, jobs))
    console.print(_fairness(console, exercise, threaded, runs, scale or [1.0, highest_scale()], jobs))
    console.print(_live_picture(console))
    if robot:
        with console.status("the robot's quick trials …"):
            rows = run_trials(quick=True, jobs=jobs)
        console.print(table_of(rows))


def _costs(exercise: Exercise, submission: Submission, jobs: int) -> Table:
    table = Table(title="What things cost (wall time, this run)")
    table.add_column("")
    table.add_column("seconds", justify="right")
    console_script = _seconds(lambda: _quietly(str(PROJECT / ".venv" / "bin" / "course"), "--help"))
    launcher = _seconds(lambda: _quietly(str(PROJECT / "course"), "--help"))
    table.add_row("the launcher's own part of a second run", f"{launcher - console_script:.2f}")
    shortest = exercise.checks[0].on[0]
    run = ArenaRun(exercise, submission.files, shortest, 0, highest_scale())
    table.add_row(
        f"one arena, from start to end (scenario {shortest.name})",
        f"{_seconds(lambda: run_in_arena(run)):.2f}",
    )

    verdicts: list[float] = []
    started = time.monotonic()

    def note(_verdict: CheckVerdict) -> None:
        verdicts.append(time.monotonic() - started)

    visible = load_exercise(EXERCISE, hidden=False)
    grade(submission, visible, jobs=jobs, report=note)
    table.add_row(f"course check {EXERCISE}: first verdict", f"{verdicts[0]:.1f}")
    table.add_row(f"course check {EXERCISE}: all {len(verdicts)} verdicts", f"{verdicts[-1]:.1f}")
    verdicts.clear()
    started = time.monotonic()
    grade(submission, exercise, jobs=jobs, report=note)
    table.add_row(f"grading {EXERCISE}: all {len(verdicts)} verdicts", f"{verdicts[-1]:.1f}")
    return table


def _checks(console: Console, name: str, jobs: int) -> Table:
    exercise = load_exercise(name, hidden=available_isolation().trusted)
    reference = read_submission(PROJECT / "solutions" / name / f"{name}.ipynb", name)
    scale = highest_scale()
    with Progress(console=console, transient=True) as progress:
        task = progress.add_task(f"{name}: one arena for each scenario", total=None)
        cost = cost_of_checks(
            reference, exercise, scale=scale, jobs=jobs, progress=lambda _scenario: progress.advance(task)
        )
    table = Table(
        title=f"The checks of {name} and their arenas, with the reference, {jobs} in parallel",
        caption="An arena that several checks judge is counted at each of them, and once in the last row.",
    )
    table.add_column("check")
    for heading in ("points", "arenas", "arena's clock s", "wall s"):
        table.add_column(heading, justify="right")
    for row in cost.checks:
        table.add_row(row.check.id, str(row.check.points), *_arenas(row.arenas))
    table.add_section()
    table.add_row("all", str(exercise.max_score()), *_arenas(cost.arenas))
    return table


def _arenas(arenas: Sequence[ArenaCost]) -> tuple[str, str, str]:
    """Cells of a row: number of arenas, their clock s, their wall s."""
    cost = total(arenas)
    return str(len(arenas)), f"{cost.clock:.1f}", f"{cost.wall:.1f}"


def _fairness(
    console: Console, exercise: Exercise, submission: Submission, runs: int, scales: list[float], jobs: int
) -> Table:
    walk = next(check.on[0] for check in exercise.checks if check.on[0].name == "walk")
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
            rates = [run.rate for run in results]
            table.add_row(
                f"{scale:g}",
                f"{sum(run.fair for run in results)}/{len(results)}",
                f"{min(rates):.2f}–{max(rates):.2f}",
                f"{max(run.gap for run in results):.2f}",
                f"{max(run.lag for run in results):.2f}",
            )
            failures += [f"scale {scale:g}: {failure}" for run in results for failure in run.failed]
    for failure in failures:
        console.print(failure, markup=False)
    return table


def _live_picture(console: Console) -> Table | str:
    """Frame rate and cost of `lab.watch_robot()`, or why there is no picture."""
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
    """The shortest of a few runs: the machine's noise only ever adds."""
    taken = []
    for _ in range(repeats):
        started = time.monotonic()
        action()
        taken.append(time.monotonic() - started)
    return min(taken)


def _quietly(*command: str) -> None:
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
