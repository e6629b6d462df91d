"""Bring the right hand to places in front of the robot, the waist helping."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from bench.robot.grasping import READY, READY_TIME, SIDE
from bench.robot.reach import HandTarget
from bench.robot.trial import Clock, Run, Summary, Trial, mean, run_of, simulate, summary, values_of
from bench.robot.trial_humanoid import TrialHumanoid
from robot_sim.arms.joint_trajectory import JointTrajectory, Waypoint
from robot_sim.model.joint_names import arm_joints

SEED = 20265
FARTHEST = 0.55  # m, from the shoulder
CLOSE = 0.01  # m


def cases(quick: bool) -> list[tuple[float, float, float]]:
    """Return places (x, y, z) m within reach of the right shoulder, in front of the body."""
    chance = random.Random(SEED)
    places: list[tuple[float, float, float]] = []
    while len(places) < (6 if quick else 41):
        place = chance.uniform(0.15, 0.55), chance.uniform(-0.55, 0.15), chance.uniform(0.65, 1.15)
        if math.dist(place, (0.0, -0.17, 0.98)) < FARTHEST:
            places.append(place)
    return places


def run(place: tuple[float, float, float]) -> Run:
    """Reach for one place."""
    clock = Clock()
    humanoid = TrialHumanoid()
    simulate(humanoid, 0.4)
    at_rest = (0.0,) * len(READY)
    humanoid.move_joints(JointTrajectory(tuple(arm_joints(SIDE)), (Waypoint(READY_TIME, READY, at_rest),)))
    simulate(humanoid, READY_TIME + 0.2)
    start = humanoid.time
    reach = humanoid.reach(SIDE, HandTarget(place, speed=0.5, with_waist=True))
    arrived = simulate(humanoid, 3.0, until=lambda: reach.error() < CLOSE)
    duration = humanoid.time - start
    simulate(humanoid, 1.0)
    error = reach.error()
    note = "" if arrived and error < CLOSE else f"{error:.3f} m away"
    return run_of(place, humanoid, clock, note, {"error_m": error, "duration_s": duration})


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row."""
    error = values_of(runs, "error_m")
    row = summary(
        "reach ≤ 0.55 m from the shoulder, waist turning",
        runs,
        measured=f"error mean {1000 * mean(error):.1f} mm, max {1000 * max(error):.1f} mm; "
        f"mean {mean(values_of(runs, 'duration_s')):.2f} s",
        reference="39/41; mean 2 mm; 1.05 s",
        met=sum(run.success for run in runs) >= 0.95 * len(runs),
    )
    return [row]


TRIAL = Trial(cases, run, summarize)
