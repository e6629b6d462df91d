"""How fast the simulation runs, with and without the controller."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco

from bench.robot.trial import Clock, Run, Summary, Trial, simulate, summary
from robot_sim.humanoid import Humanoid
from robot_sim.model.dimensions import dimensions_of
from robot_sim.model.posture import take_stance

REQUIRED = 30.0  # simulated seconds per processor second
BARE, STANDING, WALKING = "bare mj_step", "standing", "walking"
PROVEN = {STANDING: 44, WALKING: 39}  # what this controller can reach


def cases(quick: bool) -> list[tuple[str, float]]:
    """Return what to time, and for how long (simulated s)."""
    length = 10.0 if quick else 60.0
    return [(BARE, length), (STANDING, length), (WALKING, length)]


def run(case: tuple[str, float]) -> Run:
    """Time one of them."""
    what, length = case
    humanoid = Humanoid()
    simulate(humanoid, 0.5)
    if what == BARE:
        cpu = _time_bare_physics(humanoid, length)
    else:
        if what == WALKING:
            humanoid.walk_velocity(0.3, 0.0, 0.1)
        clock = Clock()
        simulate(humanoid, length)
        cpu = clock.read()
    return Run(case=what, success=True, simulated=length, cpu=cpu)


def _time_bare_physics(humanoid: Humanoid, length: float) -> float:
    """Return the processor seconds of mj_step alone; the robot is reset every 0.25 s, as nothing balances it."""
    steps = round(0.25 / humanoid.timestep)
    size = dimensions_of(humanoid.model)
    cpu = 0.0
    for _ in range(round(length / 0.25)):
        take_stance(humanoid.model, humanoid.data, size, 0.0, 0.0, 0.0)
        clock = Clock()
        mujoco.mj_step(humanoid.model, humanoid.data, steps)
        cpu += clock.read()
    return cpu


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row for each."""
    rows = []
    bare = next(run for run in runs if run.case == BARE)
    for run in runs:
        factor = run.simulated / run.cpu
        measured = f"{factor:.0f}x real time"
        reference = ""
        if run is not bare:
            measured += f", {100 * bare.cpu / run.cpu:.0f} % of the time in physics"
            reference = f"≥ {REQUIRED:.0f}x ({PROVEN[run.case]}x)"
        rows.append(
            summary(
                f"speed, {run.case}",
                [run],
                measured,
                reference,
                met=run is bare or factor >= REQUIRED,
            )
        )
    return rows


TRIAL = Trial(cases, run, summarize)
