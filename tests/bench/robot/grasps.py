"""Take the cup, lift it, hold it, put it down elsewhere."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from bench.robot.grasping import LIFT, SIDE, Grasp
from bench.robot.trial import (
    Clock,
    Run,
    Summary,
    Trial,
    all_succeeded,
    mean,
    run_of,
    simulate,
    summary,
    values_of,
)
from bench.robot.trial_humanoid import TrialHumanoid

SEED = 20263
HOLD = 2.0  # s


def cases(quick: bool) -> list[tuple[float, float, float, float]]:
    """Return places (x, y) m of the cup, before and after."""
    chance = random.Random(SEED)
    return [
        (
            chance.uniform(0.30, 0.38),
            chance.uniform(-0.28, -0.08),
            chance.uniform(0.30, 0.37),
            chance.uniform(-0.28, -0.05),
        )
        for _ in range(4 if quick else 30)
    ]


def run(case: tuple[float, float, float, float]) -> Run:
    """Move one cup."""
    from_x, from_y, to_x, to_y = case
    clock = Clock()
    humanoid = TrialHumanoid("table")
    humanoid.data.joint("cup").qpos[:2] = from_x, from_y
    simulate(humanoid, 0.5)
    grasp = Grasp(humanoid)
    height = float(grasp.cup()[2])
    note, values = _carry_out(grasp, to_x, to_y, height)
    return run_of(case, humanoid, clock, note, values)


def _carry_out(grasp: Grasp, to_x: float, to_y: float, height: float) -> tuple[str, dict[str, float]]:
    """Execute the run; return the problem, or "", and the measured values."""
    robot = grasp.robot
    grasp.get_ready()
    if not grasp.approach():
        return "the hand did not reach the cup", {}
    if not grasp.close():
        return "the fingers did not close on the cup", {}
    grasp.lift()
    slip, lowest, force = grasp.slip(), math.inf, 0.0
    for _ in range(20):
        simulate(robot, HOLD / 20)
        lowest = min(lowest, float(grasp.cup()[2]))
        force = max(force, *robot.hands[SIDE].forces)
    values = {"slip_m": slip(), "force_N": force}
    if lowest < height + LIFT - 0.03:
        return f"dropped: the cup sank to {lowest - height:.3f} m above the table", values
    values["error_m"], wrong = grasp.put_down(to_x, to_y, height)
    return wrong, values


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row."""
    error, slip = values_of(runs, "error_m"), values_of(runs, "slip_m")
    return [
        summary(
            "grasp, lift 12 cm, hold 2 s, place",
            runs,
            measured=f"place error mean {1000 * mean(error):.0f} mm, max {1000 * max(error):.0f} mm; "
            f"slip max {1000 * max(slip):.1f} mm; {mean(values_of(runs, 'force_N')):.1f} N a finger; "
            f"mean {mean(values_of(runs, 'duration_s')):.1f} s",
            reference="all; mean 2 mm; 14.6 N; 11.6 s",
            met=all_succeeded(runs),
        )
    ]


TRIAL = Trial(cases, run, summarize)
