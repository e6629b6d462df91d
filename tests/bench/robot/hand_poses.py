"""Bring either hand to poses in odom by joint angles that the inverse kinematics found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bench.robot.hand_goals import KnownGoal, known_goals
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
from robot_sim.arms.inverse_kinematics import ArmInverseKinematics, Unreachable, rotation_vector
from robot_sim.arms.joint_trajectory import JointTrajectory, Waypoint
from robot_sim.humanoid import Humanoid

DURATION = 2.0  # s, of the motion
REST_TIME = 1.0  # s
CLOSE = 0.005, 0.01  # m, rad


def cases(quick: bool) -> list[KnownGoal]:
    """Return goals of every kind, and some that are out of reach."""
    return known_goals(40 if quick else 200)


def run(case: KnownGoal) -> Run:
    """Solve the inverse kinematics of one pose and move there, or expect that it is out of reach."""
    clock = Clock()
    humanoid = Humanoid()
    simulate(humanoid, 0.5)
    name = (
        case.side.letter,
        "waist" if case.goal.with_waist else "arm only",
        "any" if case.goal.rotation is None else "oriented",
        *case.goal.position.tolist(),
    )
    base = humanoid.base_pose().position
    try:
        goal = replace(case.goal, balancing=True)
        posture = ArmInverseKinematics(humanoid.model).solve(humanoid.data, case.side, goal)
    except Unreachable as refusal:
        return run_of(name, humanoid, clock, str(refusal) if case.reachable else "")
    if not case.reachable:
        return run_of(name, humanoid, clock, "was found, though it is out of reach")
    at_rest = (0.0,) * len(posture.names)
    humanoid.move_joints(JointTrajectory(posture.names, (Waypoint(DURATION, posture.positions, at_rest),)))
    simulate(humanoid, DURATION + REST_TIME)
    hand = humanoid.hands[case.side]
    error = float(np.linalg.norm(hand.pose.position - base - goal.position))
    turn = (
        0.0 if goal.rotation is None else float(np.linalg.norm(rotation_vector(hand.rotation, goal.rotation)))
    )
    note = "" if error < CLOSE[0] and turn < CLOSE[1] else f"{error:.3f} m and {turn:.3f} rad away"
    return run_of(name, humanoid, clock, note, {"error_m": error, "turn_rad": turn})


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row; the runs that were rightly refused have no error to count."""
    moved = [run for run in runs if "error_m" in run.values]
    error, turn = values_of(moved, "error_m"), values_of(moved, "turn_rad")
    refused = sum(run.success for run in runs) - sum(run.success for run in moved)
    row = summary(
        "hand poses by inverse kinematics, both arms",
        runs,
        measured=f"error mean {1000 * mean(error):.1f} mm, max {1000 * max(error):.1f} mm; "
        f"{max(turn):.3f} rad; {refused} out of reach",
        reference=f"all within {1000 * CLOSE[0]:.0f} mm and {CLOSE[1]:g} rad, or rightly refused",
        met=all_succeeded(runs),
    )
    return [row]


TRIAL = Trial(cases, run, summarize)
