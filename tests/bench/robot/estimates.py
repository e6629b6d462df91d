"""Walk and be pushed with the state estimated from IMU, encoders and contacts instead of the ground truth."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from bench.robot.trial import (
    Clock,
    Run,
    Summary,
    Trial,
    feet_midpoint,
    mean,
    run_of,
    simulate,
    summary,
    values_of,
)
from bench.robot.trial_humanoid import TrialHumanoid

SEED = 20265
TIME_LIMIT = 30.0  # s
CALIBRATION = 1.0  # s, of standing, in which the gyro's bias is learnt
PUSH = 10.0  # N·s

GOAL, PUSHED = "goal", "push"


def cases(quick: bool) -> list[tuple[str, float, float, float, int]]:
    """Return kind, goal (x m, y m, yaw rad) or push (x, y N·s, moment s), and the seed of the sensors."""
    chance = random.Random(SEED)
    runs = 3 if quick else 32
    goals = [
        (GOAL, chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(-math.pi, math.pi), seed)
        for seed in range(runs)
    ]
    angles = [chance.uniform(-math.pi, math.pi) for _ in range(runs)]
    return goals + [
        (PUSHED, PUSH * math.cos(angle), PUSH * math.sin(angle), chance.uniform(1.5, 2.5), seed)
        for seed, angle in enumerate(angles)
    ]


def run(case: tuple[str, float, float, float, int]) -> Run:
    """Walk once."""
    kind, x, y, other, seed = case
    clock = Clock()
    humanoid = TrialHumanoid(seed=seed, estimates_state=True)
    simulate(humanoid, CALIBRATION)
    if kind == PUSHED:
        humanoid.walk_velocity(0.25, 0.0, 0.0)
        simulate(humanoid, other)
        humanoid.push((x, y, 0.0))
        simulate(humanoid, 4.0)
        return run_of(case, humanoid, clock, "")
    humanoid.walk_to(x, y, other)
    arrived = simulate(humanoid, TIME_LIMIT, until=lambda: humanoid.arrived)
    simulate(humanoid, 1.0)
    note = "" if arrived else f"not there after {TIME_LIMIT:g} s"
    error = math.dist(feet_midpoint(humanoid), (x, y))
    return run_of(case, humanoid, clock, note, {"error_m": error})


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row for the goals and one for the pushes."""
    goals = [run for run in runs if run.case[0] == GOAL]
    pushes = [run for run in runs if run.case[0] == PUSHED]
    error = values_of(goals, "error_m")
    return [
        summary(
            "state estimated: goals within 2 m",
            goals,
            measured=f"true error mean {1000 * mean(error):.0f} mm, max {1000 * max(error):.0f} mm",
            reference="all, within 0.10 m",
            met=all(run.success for run in goals) and max(error) < 0.10,
        ),
        summary(
            f"state estimated: push {PUSH:g} N·s, walking",
            pushes,
            measured=f"{sum(run.success for run in pushes)}/{len(pushes)} stay up",
            reference="31/32, as with the ground truth",
            met=sum(run.success for run in pushes) / len(pushes) >= 31 / 32,
        ),
    ]


TRIAL = Trial(cases, run, summarize)
