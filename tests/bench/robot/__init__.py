"""Trials of the humanoid: walking, stopping, balance, arms, hands, grasping, carrying, and the simulation's speed."""

from __future__ import annotations

from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

from bench.robot.balance import Crouches, Estimates, Pushes, Terrain
from bench.robot.hands import Carries, Grasps, HandPoses, Reaches
from bench.robot.speed import Speed
from bench.robot.trial import Summary, Trial
from bench.robot.walking import Goals, Limits, Servo, Soak, Speeds, Stops
from robot_sim.body import MissingParts, body_named

TRIALS: dict[str, Trial] = {
    "goals": Goals(),
    "limits": Limits(),
    "stops": Stops(),
    "servo": Servo(),
    "soak": Soak(),
    "speeds": Speeds("humanoid"),
    "pushes": Pushes(),
    "g1_speeds": Speeds("g1"),
    "g1_pushes": Pushes("g1"),
    "terrain": Terrain(),
    "estimates": Estimates(),
    "crouches": Crouches(),
    "reaches": Reaches(),
    "hand_poses": HandPoses(),
    "grasps": Grasps(),
    "carries": Carries(),
    "speed": Speed(),
}


def run_trials(names: Iterable[str] | None = None, *, quick: bool = False, jobs: int = 1) -> list[Summary]:
    """Run trials and sum them up, in the order of the names.

    Args:
        names: keys of `TRIALS`; None for all.
        quick: a few runs of each instead of the full number.
        jobs: processes that share the runs; "speed" is timed in one.

    Raises:
        ValueError: a name is not known; the message lists the known ones.
        MissingParts: a trial of an optional robot is named, and the robot's packages are not installed.
    """
    names = _possible_trials() if names is None else list(names)
    for name in names:
        if name not in TRIALS:
            raise ValueError(f"trial {name!r} is not known; choose from {', '.join(TRIALS)}")
    return [row for name in names for row in run_trial(TRIALS[name], quick, 1 if name == "speed" else jobs)]


def _possible_trials() -> list[str]:
    """Return the names of all trials, without those of an optional robot that is not installed."""
    try:
        body_named("g1")
    except MissingParts:
        return [name for name in TRIALS if not name.startswith("g1_")]
    return list(TRIALS)


def run_trial(trial: Trial, quick: bool, jobs: int) -> list[Summary]:
    """Run one trial and sum it up."""
    cases = trial.cases(quick)
    if jobs <= 1:
        return trial.summarize([trial.run(case) for case in cases])
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as processes:
        return trial.summarize(list(processes.map(trial.run, cases)))
