"""How fast the simulation runs, with and without the controller."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import mujoco

from bench.robot.trial import Attempt, Clock, Run, Summary, Trial, simulate, summary
from robot_sim.humanoid import Humanoid
from robot_sim.model.posture import take_stance


class Speed(Trial):
    """Time the physics alone, a standing robot, and a walking one."""

    REQUIRED = 30.0  # simulated seconds per processor second
    BARE, STANDING, WALKING = "bare mj_step", "standing", "walking"
    PROVEN: ClassVar = {STANDING: 44, WALKING: 39}  # what this controller can reach

    def cases(self, quick: bool) -> list[tuple[str, float]]:
        """Return what to time, and for how long (simulated s)."""
        length = 10.0 if quick else 60.0
        return [(self.BARE, length), (self.STANDING, length), (self.WALKING, length)]

    def attempt(self, case: tuple[str, float]) -> Attempt:
        """Time one of them."""
        what, length = case
        humanoid = Humanoid()
        simulate(humanoid, 0.5)
        if what == self.BARE:
            cpu = time_bare_physics(humanoid, length)
        else:
            if what == self.WALKING:
                humanoid.walk_velocity(0.3, 0.0, 0.1)
            clock = Clock()
            simulate(humanoid, length)
            cpu = clock.read()
        return humanoid, "", {"simulated_s": length, "cpu_s": cpu}

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row for each."""
        bare = runs[0].values["cpu_s"]
        rows = []
        for run in runs:
            what, cpu = run.case[0], run.values["cpu_s"]
            factor = run.values["simulated_s"] / cpu
            measured, reference = f"{factor:.0f}x real time", ""
            if what != self.BARE:
                measured += f", {100 * bare / cpu:.0f} % of the time in physics"
                reference = f"≥ {self.REQUIRED:.0f}x ({self.PROVEN[what]}x)"
            met = what == self.BARE or factor >= self.REQUIRED
            rows.append(summary(f"speed, {what}", [run], measured, reference, met=met))
        return rows


def time_bare_physics(humanoid: Humanoid, length: float) -> float:
    """Return the processor seconds of mj_step alone; the robot is reset every 0.25 s, as nothing balances it."""
    steps = round(0.25 / humanoid.timestep)
    cpu = 0.0
    for _ in range(round(length / 0.25)):
        take_stance(humanoid.model, humanoid.data)
        clock = Clock()
        mujoco.mj_step(humanoid.model, humanoid.data, steps)
        cpu += clock.read()
    return cpu
