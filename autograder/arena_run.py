"""Runs one scenario against one submission in an arena and returns the transcript."""

from __future__ import annotations

import base64
import json
import os
import sys
import threading
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from autograder import events as ev
from autograder.checks import Scenario
from autograder.exercise import Exercise
from autograder.isolation.arena_process import ArenaSpec, Ended, Kind, start_arena
from autograder.isolation.bubblewrap import SandboxError
from autograder.isolation.limits import ArenaLimits
from autograder.isolation.python_paths import python_read_only_paths
from autograder.transcript import Transcript
from ros_runtime.clock.scaled_clock import library_path

PROJECT = Path(__file__).resolve().parents[1]
DEFAULT_SCALE = 5.0
STARTUP_ALLOWANCE = 60.0  # s of wall time for the processes of an arena to start on a loaded machine
LONGEST_SCENARIO = 150.0  # s on the arena's clock
REPORT_LIMIT = 64 * 2**20  # bytes of events


class NotGraded(Exception):
    """The run cannot be judged, for a reason that is not the student's."""


@dataclass(frozen=True)
class ArenaRun:
    """What to run: the files of a submission, a scenario with its inputs, and how fast the arena's clock shall go."""

    exercise: Exercise
    files: Mapping[str, bytes]
    scenario: Scenario
    seed: int = 0
    scale: float = DEFAULT_SCALE
    kind: Kind | None = None


def highest_scale() -> float:
    """Return the scale arenas run at unless told otherwise: 1 where the clock's library could not be built."""
    return DEFAULT_SCALE if library_path() else 1.0


def run_in_arena(run: ArenaRun, stop: threading.Event | None = None) -> Transcript:
    """Carry out the scenario; raises :class:`NotGraded` when the arena failed. `stop` ends the arena early."""
    params = run.scenario.draw(run.seed)
    scale = run.scale if run.scenario.timed else 1.0
    read_end, write_end = os.pipe()
    limits = ArenaLimits(deadline_s=STARTUP_ALLOWANCE + LONGEST_SCENARIO / scale)
    spec = ArenaSpec(
        [sys.executable, "-m", "autograder.arena.clocked_start", str(write_end)],
        read_only_paths=[*_ros_paths(), *_trusted_paths(run.exercise)],
        pass_fds=[write_end],
        env={"PYTHONPATH": str(PROJECT), "PYTHONDONTWRITEBYTECODE": "1"},
        stdin=json.dumps(_specification(run, params, scale)).encode(),
        limits=limits,
    )
    try:
        arena = start_arena(spec, run.kind)
    except SandboxError as error:
        os.close(read_end)
        raise NotGraded(str(error)) from error
    finally:
        os.close(write_end)
    watcher = threading.Thread(target=_kill_on, args=(stop, arena), daemon=True) if stop else None
    if watcher:
        watcher.start()
    with os.fdopen(read_end, "rb") as pipe:
        report = pipe.read(REPORT_LIMIT)
    if len(report) == REPORT_LIMIT:
        arena.kill()
    ended = arena.wait()
    events = _parse(report)
    reason = _why_not_graded(events, ended.ended)
    if reason:
        details = f"{ended.explain(limits)}\n{ended.stderr.text[-2000:]}"
        raise NotGraded(f"scenario {run.scenario.name}: {reason}; {details}")
    return Transcript.from_events(run.scenario.name, params, events, scale)


def _specification(run: ArenaRun, params: dict[str, Any], scale: float) -> dict[str, Any]:
    return {
        "module": run.exercise.scenario_module,
        "scenario": run.scenario.name,
        "params": params,
        "namespace": run.scenario.namespace,
        "robot_options": None if run.scenario.robot is None else list(run.scenario.robot),
        "student": run.scenario.student,
        "parameters": dict(run.scenario.parameters),
        "file_name": run.exercise.file_names[0],
        "files": {name: base64.b64encode(content).decode() for name, content in run.files.items()},
        "scale": scale,
        "timed": run.scenario.timed,
        "student_paths": [str(path) for path in (*_ros_paths(), PROJECT / "ros_runtime")],
    }


def _ros_paths() -> list[Path]:
    """What any ROS process needs to see: Python with its packages, and a sourced ROS 2 where there is one."""
    sourced = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    return [
        *python_read_only_paths(),
        *(Path(prefix) for prefix in sourced if prefix.startswith("/opt/ros/")),
    ]


def _trusted_paths(exercise: Exercise) -> list[Path]:
    """What the agent may see of the project: no checks, no solutions, no other submissions."""
    grader = PROJECT / "autograder"
    scenarios = grader / "exercises" / exercise.name
    return [
        PROJECT / "ros_runtime",
        PROJECT / "robot_sim",
        grader / "__init__.py",
        grader / "arena",
        grader / "isolation",
        grader / "exercises" / "__init__.py",
        scenarios / "__init__.py",
        scenarios / "scenarios.py",
    ]


def _kill_on(stop: threading.Event, arena: Any) -> None:
    while arena.poll() is None:
        if stop.wait(0.1):
            arena.kill()
            return


def _parse(report: bytes) -> list[Any]:
    """Read the events; a last line cut short by the arena's end is dropped."""
    *lines, _unfinished = report.split(b"\n")
    try:
        return [ev.parse_event(line) for line in lines]
    except ValidationError as error:
        raise NotGraded(f"the arena's report cannot be read: {error}") from error


def _why_not_graded(events: list[Any], ended: Ended) -> str | None:
    """Return why the arena itself failed, or None."""
    failed = next((event for event in events if isinstance(event, ev.ScenarioFailed)), None)
    if failed:
        return failed.reason
    if any(isinstance(event, ev.ScenarioEnded) for event in events):
        return None
    return f"it did not come to its end ({ended.value})"
