"""Measures what arenas and gradings cost."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from bench.arena.processor_time import metered_group
from ros_runtime.course_error import COMMAND_FAILED, CourseError
from ros_runtime.project import PROJECT

ARENAS = (  # the first scenario of a check
    ("battery_service", "answers_with_the_last_message"),  # the robot rests
    ("robot_controller", "prints_the_status"),  # no robot
    ("joint_query", "positions_are_the_robots"),  # it stands and moves its arms
    ("cancellable_walk", "arrives"),
)


class BenchFailed(CourseError):
    """A measured run failed."""

    exit_status = COMMAND_FAILED


@dataclass(frozen=True)
class Cost:
    """Processor and wall time, s."""

    cpu_s: float
    wall_s: float


@dataclass(frozen=True)
class ArenaCost:
    """The cost of one scenario in an open arena.

    `floor_s` is the scenario's own time over the scale of its clock, `robot_second_cpu_s` what the simulator uses for
    one second of the robot's time, None without a robot.
    """

    exercise: str
    scenario: str
    cpu_s: float
    wall_s: float
    floor_s: float
    opening: Cost = Cost(0.0, 0.0)
    phases: dict[str, Cost] = field(default_factory=dict)
    robot_second_cpu_s: float | None = None


@dataclass(frozen=True)
class SubmissionCost:
    """The cost of grading the reference solution, with hidden checks."""

    exercise: str
    cpu_s: float
    wall_s: float
    floor_s: float


@dataclass(frozen=True)
class Costs:
    """What was measured in one run of `course bench`."""

    arenas: Sequence[ArenaCost] = ()
    submissions: Sequence[SubmissionCost] = ()

    def to_json(self) -> dict[str, Any]:
        """Return what `--json` writes."""
        return asdict(self)

    @classmethod
    def from_json(cls, record: dict[str, Any]) -> Costs:
        """Read back what `to_json` returned, of any version."""
        arenas = [
            ArenaCost(
                **{key: arena[key] for key in ("exercise", "scenario", "cpu_s", "wall_s", "floor_s")},
                opening=Cost(**arena.get("opening", {"cpu_s": 0.0, "wall_s": 0.0})),
                phases={name: Cost(**cost) for name, cost in arena.get("phases", {}).items()},
                robot_second_cpu_s=arena.get("robot_second_cpu_s"),
            )
            for arena in record.get("arenas", ())
        ]
        return cls(arenas, [SubmissionCost(**one) for one in record.get("submissions", ())])


def measure(
    *,
    arenas: Sequence[tuple[str, str]] = (),
    submissions: Sequence[str] = (),
    runs: int = 5,
    jobs: int = 2,
    progress: Callable[[str], None] = lambda what: None,
) -> Costs:
    """Measure arenas and gradings; the best of several runs counts, because a machine's noise only adds time.

    Raises:
        BenchFailed: a run failed.
        CannotBeMeasured: this machine cannot count processor time.
    """
    arena_costs: list[ArenaCost] = []
    submission_costs: list[SubmissionCost] = []
    for exercise, scenario in arenas:
        progress(f"{exercise} {scenario}, {runs} times")
        task = {"exercise": exercise, "scenario": scenario, "runs": runs, "jobs": 1}
        arena_costs.append(_arena_cost(exercise, scenario, list(_run(task))))
    for exercise in submissions:
        progress(f"{exercise} graded, {runs} times")
        task = {"exercise": exercise, "scenario": "", "runs": runs, "jobs": jobs}
        submission_costs.append(_submission_cost(exercise, list(_run(task))))
    return Costs(arena_costs, submission_costs)


def _arena_cost(exercise: str, scenario: str, runs: Sequence[dict[str, Any]]) -> ArenaCost:
    later = [run for run in runs if not run["opens"]]
    best = min(later, key=lambda run: run["cpu_s"])
    opening = next((run for run in runs if run["opens"]), None)
    phases = {name: Cost(**cost) for name, cost in (opening or {"phases": {}})["phases"].items()}
    phases |= {name: Cost(**cost) for name, cost in best["phases"].items()}
    wall = min(run["wall_s"] for run in later)
    extra = Cost(opening["cpu_s"] - best["cpu_s"], opening["wall_s"] - wall) if opening else Cost(0.0, 0.0)
    seconds = [run["robot_second_cpu_s"] for run in later if run["robot_second_cpu_s"]]
    robot = min(seconds, default=None)
    return ArenaCost(exercise, scenario, best["cpu_s"], wall, best["floor_s"], extra, phases, robot)


def _submission_cost(exercise: str, runs: Sequence[dict[str, Any]]) -> SubmissionCost:
    if failed := sum(not run["passed"] for run in runs):
        raise BenchFailed(
            f"the reference of {exercise} did not pass every check in {failed} of {len(runs)} runs"
        )
    cpu, wall = (min(run[key] for run in runs) for key in ("cpu_s", "wall_s"))
    return SubmissionCost(exercise, cpu, wall, min(run["floor_s"] for run in runs))


def _run(task: dict[str, Any]) -> Iterator[dict[str, Any]]:
    with metered_group() as (processes, meter):
        task = {**task, "meter": meter}
        command = [sys.executable, "-m", "bench.arena.measured_run", json.dumps(task)]
        process = subprocess.Popen(
            ["/bin/sh", "-c", 'echo $$ > "$0" && exec "$@"', str(processes), *command],
            cwd=PROJECT / "tests",
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        output, errors = process.communicate()
    if process.returncode:
        raise BenchFailed(f"a run of {task['exercise']} failed: {errors[-2000:]}")
    yield from map(json.loads, output.splitlines())
