"""Stop at a random moment of a random walk."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from bench.robot.trial import (
    Clock,
    Run,
    Summary,
    Trial,
    all_succeeded,
    base_speed,
    has_fallen,
    mean,
    simulate,
    summary,
    values_of,
)
from robot_sim.humanoid import Humanoid

FIRST_SEED = 7000
STOPPED = 0.05  # m/s
ALLOWED = 2.0  # s


def cases(quick: bool) -> list[int]:
    """Return seeds."""
    return [FIRST_SEED + index for index in range(12 if quick else 60)]


def run(seed: int) -> Run:
    """Walk for a while, stop, and watch the pelvis for four seconds."""
    clock = Clock()
    chance = random.Random(seed)
    humanoid = Humanoid()
    simulate(humanoid, 0.5)
    if chance.random() < 0.5:
        humanoid.walk_velocity(
            chance.uniform(-0.2, 0.45), chance.uniform(-0.12, 0.12), chance.uniform(-0.45, 0.45)
        )
    else:
        humanoid.walk_to(chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(-3, 3))
    simulate(humanoid, chance.uniform(0.1, 4.0))
    start_x, start_y, _ = humanoid.base_pose().position
    stop = last_moving = humanoid.time
    if chance.random() < 0.5:
        humanoid.stop()
    else:
        humanoid.walk_velocity(0.0, 0.0, 0.0)
    for _ in range(round(4.0 / humanoid.timestep)):
        humanoid.step()
        if base_speed(humanoid) >= STOPPED:
            last_moving = humanoid.time
    x, y, _ = humanoid.base_pose().position
    settling = last_moving - stop
    note = "fell" if has_fallen(humanoid) else f"took {settling:.2f} s" if settling > ALLOWED else ""
    return Run(
        case=seed,
        success=not note,
        note=note,
        values={"settling_s": settling, "travel_m": math.hypot(x - start_x, y - start_y)},
        simulated=humanoid.time,
        cpu=clock.read(),
    )


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row."""
    settling, travel = values_of(runs, "settling_s"), values_of(runs, "travel_m")
    return [
        summary(
            f"stop mid-walk, base < {STOPPED} m/s within {ALLOWED:g} s",
            runs,
            measured=f"mean {mean(settling):.2f} s, max {max(settling):.2f} s; "
            f"travel mean {mean(travel):.2f} m, max {max(travel):.2f} m",
            reference="all; mean 0.48 s, max 0.92 s; travel mean 0.07 m, max 0.20 m",
            met=all_succeeded(runs) and max(settling) < 1.2,
        )
    ]


TRIAL = Trial(cases, run, summarize)
