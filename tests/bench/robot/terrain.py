"""Walk over floors that are not flat: slopes in every direction, and bumps strewn over the way."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from bench.robot.floor import Floor
from bench.robot.trial import Clock, Run, Summary, Trial, run_of, simulate, summary
from robot_sim.humanoid import Humanoid

DISTANCE = 2.0  # m
TIME_LIMIT = 30.0  # s
BUMPS_A_SQUARE_METRE = 12
CLEAR = 0.3  # m around the feet at the start
REFERENCE = {  # runs of 24 that arrive, for slopes in degrees and bumps in m
    ("slope", 2.0): 24,
    ("slope", 3.0): 24,
    ("slope", 5.0): 24,
    ("bumps", 0.005): 24,
    ("bumps", 0.010): 24,
}


def cases(quick: bool) -> list[tuple[str, float, int]]:
    """Return kind of floor, slope (degrees) or height (m), and a seed."""
    return [(kind, size, seed) for kind, size in REFERENCE for seed in range(2 if quick else 24)]


def run(case: tuple[str, float, int]) -> Run:
    """Walk two metres in some direction and stand there."""
    kind, size, seed = case
    chance = random.Random(f"{kind}/{size}/{seed}")
    direction, uphill = chance.uniform(-math.pi, math.pi), chance.uniform(-math.pi, math.pi)
    floor = Floor(math.radians(size), uphill) if kind == "slope" else Floor(bumps=strewn(chance, size))
    clock = Clock()
    humanoid = Humanoid(shape=floor.shape)
    simulate(humanoid, 1.0)
    humanoid.walk_to(DISTANCE * math.cos(direction), DISTANCE * math.sin(direction), direction)
    arrived = simulate(humanoid, TIME_LIMIT, until=lambda: humanoid.arrived)
    simulate(humanoid, 1.0)
    return run_of(case, humanoid, clock, "" if arrived else f"not there after {TIME_LIMIT:g} s")


def strewn(chance: random.Random, height: float) -> tuple[tuple[float, float, float], ...]:
    """Return bumps everywhere but under the feet."""
    reach = DISTANCE + 0.5
    places = [
        (chance.uniform(-reach, reach), chance.uniform(-reach, reach))
        for _ in range(round(BUMPS_A_SQUARE_METRE * 4 * reach**2))
    ]
    return tuple((x, y, height) for x, y in places if math.hypot(x, y) > CLEAR)


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row for each floor."""
    rows = []
    for (kind, size), of_24 in REFERENCE.items():
        group = [run for run in runs if run.case[:2] == (kind, size)]
        arrived = sum(run.success for run in group)
        rows.append(
            summary(
                f"slope of {size:g}°, any direction" if kind == "slope" else f"bumps of {1000 * size:g} mm",
                group,
                measured=f"{arrived}/{len(group)} arrive after {DISTANCE:g} m",
                reference=f"{of_24}/24",
                met=arrived / len(group) >= of_24 / 24,
            )
        )
    return rows


TRIAL = Trial(cases, run, summarize)
