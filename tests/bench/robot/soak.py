"""Goals, velocities and stops at random, each interrupting the one before."""

from __future__ import annotations

import random
from collections.abc import Sequence

from bench.robot.trial import Clock, Run, Summary, Trial, all_succeeded, has_fallen, simulate, summary
from robot_sim.humanoid import Humanoid


def cases(quick: bool) -> list[tuple[int, float]]:
    """Return seed and length (simulated s)."""
    return [(300 + index, 45.0 if quick else 600.0) for index in range(2 if quick else 4)]


def run(case: tuple[int, float]) -> Run:
    """Command at random for the whole length; a fallen robot is stood up again and counted."""
    seed, length = case
    clock = Clock()
    chance = random.Random(seed)
    humanoid = Humanoid()
    simulated, falls, commands, fell_at = 0.0, 0, 0, ""
    while simulated < length:
        command = _command_at_random(humanoid, chance)
        commands += 1
        before = humanoid.time
        simulate(humanoid, chance.uniform(0.3, 8.0))
        simulated += humanoid.time - before
        if has_fallen(humanoid):
            falls += 1
            fell_at = command
            humanoid.reset()
    return Run(
        case=f"seed {seed}, {length / 60:.1f} min, {commands} commands",
        success=falls == 0,
        note=f"{falls} falls, the last at {fell_at}" if falls else "",
        values={"falls": falls, "minutes": simulated / 60},
        simulated=simulated,
        cpu=clock.read(),
    )


def _command_at_random(humanoid: Humanoid, chance: random.Random) -> str:
    kind = chance.random()
    if kind < 0.45:
        x, y, _ = humanoid.base_pose().position
        goal = x + chance.uniform(-2, 2), y + chance.uniform(-2, 2), chance.uniform(-3.1, 3.1)
        humanoid.walk_to(*goal)
        return f"goal {goal}"
    if kind < 0.75:
        velocity = chance.uniform(-0.25, 0.5), chance.uniform(-0.12, 0.12), chance.uniform(-0.5, 0.5)
        humanoid.walk_velocity(*velocity)
        return f"velocity {velocity}"
    humanoid.stop()
    return "stop"


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row."""
    falls = sum(int(run.values["falls"]) for run in runs)
    minutes = sum(run.values["minutes"] for run in runs)
    return [
        summary(
            "random commands, pre-empted every 0.3-8 s",
            runs,
            measured=f"{falls} falls in {minutes:.1f} simulated min",
            reference="0 falls in 40 min",
            met=all_succeeded(runs),
        )
    ]


TRIAL = Trial(cases, run, summarize)
