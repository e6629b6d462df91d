"""Crouch, be pushed, rise, walk on."""

import math
import random
from collections.abc import Sequence

from robot_sim.humanoid import Humanoid
from robot_sim.trials.trial import (
    Clock,
    Run,
    Summary,
    Trial,
    all_succeeded,
    run_of,
    simulate,
    summary,
    values_of,
)

SEED = 20266
STANCE = 0.60  # m, height of the pelvis
IMPULSE = 8.0  # N·s


def cases(quick: bool) -> list[tuple[float, float]]:
    """Height (m) of the crouch and direction (rad) of the push."""
    chance = random.Random(SEED)
    return [
        (chance.uniform(0.45, 0.52), chance.uniform(-math.pi, math.pi)) for _ in range(4 if quick else 24)
    ]


def run(case: tuple[float, float]) -> Run:
    """One crouch."""
    height, direction = case
    clock = Clock()
    humanoid = Humanoid()
    humanoid.reset(height=height)
    simulate(humanoid, 0.5)
    humanoid.push((IMPULSE * math.cos(direction), IMPULSE * math.sin(direction), 0.0))
    simulate(humanoid, 2.5)
    humanoid.move_body(0.1)
    simulate(humanoid, 2.5)
    error = abs(float(humanoid.base_pose().position[2]) - STANCE)
    humanoid.walk_to(0.5, 0.0, 0.0)
    arrived = simulate(humanoid, 15.0, until=lambda: humanoid.arrived)
    note = (
        "" if arrived and error < 0.01 else f"rose to within {error:.3f} m" if arrived else "did not walk on"
    )
    return run_of(case, humanoid, clock, note, {"error_m": error})


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """One row."""
    return [
        summary(
            "crouch, 8 N·s, rise, walk on",
            runs,
            measured=f"stance reached within {1000 * max(values_of(runs, 'error_m')):.1f} mm",
            reference="all",
            met=all_succeeded(runs),
        )
    ]


TRIAL = Trial(cases, run, summarize)
