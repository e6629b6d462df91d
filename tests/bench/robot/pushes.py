"""Push the torso from any direction, standing and walking, and from the side, where walking is weakest."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from bench.robot.trial import Clock, Run, Summary, Trial, has_fallen, simulate, summary
from robot_sim.humanoid import Humanoid

DURATION = 0.1  # s
REFERENCE = {  # survivals of 32 for gait, impulse in N·s
    ("standing", 10): 32,
    ("standing", 14): 32,
    ("standing", 18): 31,
    ("walking", 10): 31,
    ("walking", 14): 27,
    ("walking", 18): 20,
    ("walking, from the side", 10): 29,
    ("walking, from the side", 14): 29,
}


def cases(quick: bool) -> list[tuple[str, int, int]]:
    """Return gait, impulse (N·s) and seed."""
    return [
        (gait, impulse, seed)
        for gait, impulse in REFERENCE
        for seed in range(32)
        if not quick or (seed < 6 and impulse == 10)
    ]


def run(case: tuple[str, int, int]) -> Run:
    """Push once at a random moment from a random direction; the robot survives if it is up four seconds later."""
    gait, impulse, seed = case
    clock = Clock()
    chance = random.Random(seed)
    humanoid = Humanoid()
    simulate(humanoid, 0.5)
    if gait.startswith("walking"):
        humanoid.walk_velocity(0.25, 0.0, 0.0)
    simulate(humanoid, chance.uniform(1.5, 2.5))
    direction = chance.uniform(-math.pi, math.pi)
    if gait.endswith("side"):
        direction = math.copysign(math.pi / 2, direction)
    humanoid.push((impulse * math.cos(direction), impulse * math.sin(direction), 0.0), DURATION)
    simulate(humanoid, 4.0)
    fell = has_fallen(humanoid)
    return Run(
        case=case,
        success=not fell,
        note=f"fell, pushed towards {math.degrees(direction):.0f}°" if fell else "",
        simulated=humanoid.time,
        cpu=clock.read(),
    )


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row for each gait and impulse."""
    rows = []
    for (gait, impulse), of_32 in REFERENCE.items():
        group = [run for run in runs if run.case[:2] == (gait, impulse)]
        if group:
            survived = sum(run.success for run in group)
            rows.append(
                summary(
                    f"push {impulse} N·s in {DURATION} s, {gait}",
                    group,
                    measured=f"{survived}/{len(group)} stay up",
                    reference=f"{of_32}/32",
                    met=survived / len(group) >= of_32 / 32,
                )
            )
    return rows


TRIAL = Trial(cases, run, summarize)
