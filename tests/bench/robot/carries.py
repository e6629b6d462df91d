"""Walk to the table, take the cup, carry it away, turn, come back to another place of the table, put it down."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from bench.robot.grasping import Grasp
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
from robot_sim.arms.joint_trajectory import HOLD

SEED = 20264
DISTANCE = 1.5  # m, from the table's edge region where the robot starts


def cases(quick: bool) -> list[tuple[float, float, float]]:
    """Return where the cup stands, (x, y) m, and how far (m) to the side the robot stops at the table."""
    chance = random.Random(SEED)
    return [
        (chance.uniform(0.31, 0.36), chance.uniform(-0.24, -0.10), chance.uniform(-0.02, 0.02))
        for _ in range(2 if quick else 12)
    ]


def run(case: tuple[float, float, float]) -> Run:
    """Carry the cup once."""
    x, y, offset = case
    clock = Clock()
    humanoid = TrialHumanoid("table")
    humanoid.reset(x=-DISTANCE)
    humanoid.data.joint("cup").qpos[:2] = x, y
    simulate(humanoid, 0.5)
    grasp = Grasp(humanoid)
    note, values = _carry_out(grasp, offset)
    return run_of(case, humanoid, clock, note, values)


def _carry_out(grasp: Grasp, offset: float) -> tuple[str, dict[str, float]]:
    """Execute the run; return the problem, or "", and the measured values."""
    robot = grasp.robot
    table = float(grasp.cup()[2])
    if not _walk(robot, 0.03, offset, 0.0):
        return "it did not arrive at the table", {}
    grasp.get_ready()
    if not grasp.approach():
        return "the hand did not reach the cup", {}
    if not grasp.close():
        return "the fingers did not close on the cup", {}
    grasp.lift()
    robot.move_joints(HOLD)  # the hand travels with the body now
    slip = grasp.slip()
    if not (_walk(robot, -0.45, 0.0, 0.0) and _walk(robot, -1.0, 0.9, math.pi / 2)):
        return "it did not arrive with the cup", {}
    values = {"slip_m": slip()}
    if values["slip_m"] > 0.02 or not grasp.holds():
        return f"lost: the cup moved {values['slip_m']:.3f} m in the hand", values
    if not (_walk(robot, -0.45, 0.0, 0.0) and _walk(robot, 0.03, 0.0, 0.0)):
        return "it did not come back to the table", values
    values["error_m"], wrong = grasp.put_down(0.33, -0.17, table)
    return wrong, values


def _walk(robot: TrialHumanoid, x: float, y: float, yaw: float) -> bool:
    robot.walk_to(x, y, yaw)
    arrived = simulate(robot, 25.0, until=lambda: robot.arrived)
    simulate(robot, 0.6)
    return arrived


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row."""
    error, slip = values_of(runs, "error_m"), values_of(runs, "slip_m")
    return [
        summary(
            "walk to the table, grasp, carry, turn, put down",
            runs,
            measured=f"slip max {1000 * max(slip):.1f} mm; place error mean {1000 * mean(error):.0f} mm, "
            f"max {1000 * max(error):.0f} mm; mean {mean(values_of(runs, 'duration_s')):.1f} s",
            reference="12/12 (carried, not put down)",
            met=all_succeeded(runs),
        )
    ]


TRIAL = Trial(cases, run, summarize)
