"""Runs one scenario against one submission in an arena and returns the transcript."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from autograder.arena.scenario_spec import ScenarioSpec
from autograder.authoring.checks import Scenario
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.clock_scale import USUAL, scale_of
from autograder.engine.exercise import Exercise
from autograder.engine.stop import Stop
from autograder.engine.submission_arena import LIMITS, ArenaEnded, student_paths
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.isolation.arena_process import ArenaReport, Ended, Kind
from autograder.isolation.bubblewrap import SandboxError

STARTUP_ALLOWANCE = 60.0  # s of wall time for the processes of an arena to start on a loaded machine
LONGEST_SCENARIO = 150.0  # s on the arena's clock, for the deadline


class NotGraded(Exception):
    """The run cannot be judged, and the submission is not the cause."""


@dataclass(frozen=True)
class ArenaRun:
    """What to run: the files of a submission, a scenario with its inputs, and the speed of the arena's clock.

    Attributes:
        exercise, files: the submission.
        scenario, seed: the stimulus, and the seed that draws its inputs.
        scale: speed of the arena's clock, as a multiple of real time.
        kind: how the arena is isolated; None: the best that this machine offers.
        measured: record what each phase costs.
        recorded: have the simulator report whole postures, for a film.
    """

    exercise: Exercise
    files: Mapping[str, bytes]
    scenario: Scenario
    seed: int = 0
    scale: float = USUAL
    kind: Kind | None = None
    measured: bool = False
    recorded: bool = False


def run_in_arena(
    run: ArenaRun, stop: Stop | None = None, arenas: SubmissionArenas | None = None
) -> Transcript:
    """Carry out the scenario in one of the submission's `arenas`, or in one for it alone.

    Args:
        run: what to run.
        stop: when it is set, the arena ends early.
        arenas: those of this submission.

    Raises:
        NotGraded: the arena failed.
    """
    if arenas is None:
        with SubmissionArenas(run.exercise.scenario_file, run.kind) as arenas:
            return run_in_arena(run, stop, arenas)
    params = run.scenario.draw(run.seed)
    scale = scale_of(run.scenario, run.scale)
    deadline = STARTUP_ALLOWANCE + LONGEST_SCENARIO / scale
    try:
        with arenas.one() as arena:
            is_isolated = arena.kind is Kind.NAMESPACES
            report = arena.carry_out(_specification(run, params, scale, is_isolated), deadline, stop)
            return _transcript(run, params, scale, report)
    except ArenaEnded as error:
        if error.report.ended is Ended.MEMORY:
            return _broken_off(run, params, scale, error.events, error.report)
        raise NotGraded(f"scenario {run.scenario.name}: {error}") from error
    except SandboxError as error:
        raise NotGraded(f"scenario {run.scenario.name}: {error}") from error


def _specification(run: ArenaRun, params: dict[str, Any], scale: float, is_isolated: bool) -> ScenarioSpec:
    scenario = run.scenario
    return ScenarioSpec(
        scenario_file=str(run.exercise.scenario_file),
        scenario=scenario.name,
        params=params,
        scale=scale,
        timed=scenario.timed,
        namespace=scenario.namespace,
        robot_options=scenario.robot,
        student=scenario.student,
        program=run.exercise.file_names[0],
        files=run.files,
        parameters=scenario.parameters,
        student_paths=[str(path) for path in student_paths()],
        private_network=is_isolated,
        measured=run.measured,
        recorded=run.recorded,
    )


def _transcript(run: ArenaRun, params: dict[str, Any], scale: float, report: bytes) -> Transcript:
    """Read the events of a scenario that ran to its end; raise NotGraded if it did not."""
    events = read_events(report)
    failed = next((event for event in events if isinstance(event, ev.ScenarioFailed)), None)
    if failed:
        raise NotGraded(f"scenario {run.scenario.name}: {failed.reason}")
    if not any(isinstance(event, ev.ScenarioEnded) for event in events):
        raise NotGraded(f"scenario {run.scenario.name}: it ended early, without an error message")
    return Transcript.from_events(run.scenario.name, params, events, scale)


def _broken_off(
    run: ArenaRun, params: dict[str, Any], scale: float, report: bytes, ended: ArenaReport
) -> Transcript:
    """Read the events up to the end of an arena that exceeded its memory; only a submission can use that much."""
    events = read_events(report)
    last = max((event.t for event in events), default=0.0)
    events.append(ev.ArenaOverfull(t=last, memory_mib=ended.peak_memory_mib, limit_mib=LIMITS.memory_mib))
    return Transcript.from_events(run.scenario.name, params, events, scale)


def read_events(report: bytes) -> list[Any]:
    """Read the events; a last line cut short by the end of a process is dropped."""
    *lines, _unfinished = report.split(b"\n")
    try:
        return [ev.parse_event(line) for line in lines]
    except ValueError as error:
        raise NotGraded(f"the arena's report cannot be read: {str(error)[:2000]}") from error
