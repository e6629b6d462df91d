"""Runs a scenario or a grading again and again, and prints the cost of each run as a JSON object on a line.

Run as `python -m bench.arena.measured_run TASK` in a process of its own, so that nothing else is counted. TASK is
JSON: the `exercise` whose reference solution is run, the `scenario` (none: the whole grading), how many `runs`, with
how many `jobs`, and the `meter` of `processor_time`.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from autograder.authoring.evidence import events as ev
from autograder.engine.arena_run import ArenaRun, run_in_arena
from autograder.engine.exercise import Exercise, load_exercise
from autograder.engine.grading import GradingOptions, Watcher, grade
from autograder.engine.submission import Submission, read_submission
from autograder.engine.submission_arenas import SubmissionArenas
from bench.arena.robot_watch import RobotWatch
from ros_runtime.project import PROJECT


def main() -> None:
    """Execute the task."""
    task = json.loads(sys.argv[1])
    name = task["exercise"]
    reference = PROJECT / "solutions" / name / f"{name}.ipynb"
    exercise, submission = load_exercise(name, hidden=True), read_submission(reference, name)
    for cost in (
        _arenas(task, exercise, submission) if task["scenario"] else _gradings(task, exercise, submission)
    ):
        print(json.dumps(cost), flush=True)


def _arenas(task: dict[str, Any], exercise: Exercise, submission: Submission) -> Iterator[dict[str, Any]]:
    """Run a scenario again and again in one arena; the run that opens it is marked."""
    named = (check.on[0] for check in exercise.checks if check.id == task["scenario"])
    run = ArenaRun(exercise, submission.files, next(named), measured=True)
    with SubmissionArenas(exercise.scenario_file) as arenas:
        for number in range(task["runs"] + 1):
            before = _used(task["meter"]), time.monotonic()
            with RobotWatch() as watch:
                transcript = run_in_arena(run, arenas=arenas)
            after = _used(task["meter"]), time.monotonic()
            phases = {
                event.name: {"cpu_s": event.cpu, "wall_s": event.wall}
                for event in transcript.all(ev.PhaseEnded)
            }
            yield {
                **_difference(before, after),
                "floor_s": _floor(transcript),
                "phases": phases,
                "opens": number == 0,
                "robot_second_cpu_s": (second := watch.cpu_per_second()) and second / transcript.scale,
            }


def _gradings(task: dict[str, Any], exercise: Exercise, submission: Submission) -> Iterator[dict[str, Any]]:
    for _ in range(task["runs"]):
        transcripts: dict[int, Any] = {}

        def keep(_verdict: Any, seen: Sequence[Any], kept: dict[int, Any] = transcripts) -> None:
            kept.update({id(one): one for one in seen})

        before = _used(task["meter"]), time.monotonic()
        result = grade(submission, exercise, GradingOptions(jobs=task["jobs"]), Watcher(on_evidence=keep))
        after = _used(task["meter"]), time.monotonic()
        floor = sum(map(_floor, transcripts.values())) / task["jobs"]
        yield {**_difference(before, after), "floor_s": floor, "passed": result.all_passed}


def _floor(transcript: Any) -> float:
    """Return what the scenario itself takes (wall s): its time on the arena's clock over the scale."""
    began = transcript.first(ev.NodeReady) or transcript.first(ev.NodeStarted)
    ended = transcript.first(ev.ScenarioEnded)
    return max(0.0, (ended.t - began.t) / transcript.scale) if began and ended else 0.0


def _difference(before: tuple[float, float], after: tuple[float, float]) -> dict[str, float]:
    return {"cpu_s": after[0] - before[0], "wall_s": after[1] - before[1]}


def _used(meter: str) -> float:
    """Return the processor time (s) used so far by this process and everything it started."""
    content = Path(meter).read_text()
    if meter.endswith("cpu.stat"):
        return int(content.split("usage_usec ", 1)[1].split()[0]) * 1e-6
    return int(content) * 1e-9


if __name__ == "__main__":
    main()
