"""Walk to poses around the robot."""

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
    feet_midpoint,
    has_fallen,
    mean,
    simulate,
    summary,
    values_of,
)
from robot_sim.humanoid import Humanoid
from robot_sim.model.side import SIDES
from ros_runtime.angles import wrap

SEED = 20260
TIME_LIMIT = 30.0  # s


def cases(quick: bool) -> list[tuple[float, float, float]]:
    """Return goals (x m, y m, yaw rad) within 2 m to each side, with any heading."""
    chance = random.Random(SEED)
    return [
        (chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(-math.pi, math.pi))
        for _ in range(8 if quick else 60)
    ]


def run(goal: tuple[float, float, float]) -> Run:
    """Walk to one goal and stand there."""
    clock = Clock()
    humanoid = Humanoid()
    simulate(humanoid, 0.5)
    start = humanoid.time
    humanoid.walk_to(*goal)
    arrived = simulate(humanoid, TIME_LIMIT, until=lambda: humanoid.arrived)
    duration = humanoid.time - start
    simulate(humanoid, 1.5)
    note = "fell" if has_fallen(humanoid) else "" if arrived else f"not there after {TIME_LIMIT:g} s"
    left, right = (humanoid.data.site(f"{side.letter}_sole") for side in SIDES)
    facing = (left.xmat + right.xmat).tolist()
    return Run(
        case=tuple(round(number, 2) for number in goal),
        success=not note,
        note=note,
        values={
            "error_m": math.dist(goal[:2], feet_midpoint(humanoid)),
            "yaw_error_rad": abs(wrap(goal[2] - math.atan2(facing[3], facing[0]))),
            "duration_s": duration,
        },
        simulated=humanoid.time,
        cpu=clock.read(),
    )


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row."""
    error, yaw_error = values_of(runs, "error_m"), values_of(runs, "yaw_error_rad")
    return [
        summary(
            "goals within 2 m, any heading",
            runs,
            measured=f"error mean {1000 * mean(error):.0f} mm, max {1000 * max(error):.0f} mm; "
            f"yaw max {max(yaw_error):.3f} rad; mean {mean(values_of(runs, 'duration_s')):.1f} s",
            reference="all; mean 3 mm, max 19 mm; yaw ≤ 0.05 rad; mean 7.2 s",
            met=all_succeeded(runs) and max(error) < 0.03 and max(yaw_error) < 0.06,
        )
    ]


TRIAL = Trial(cases, run, summarize)
