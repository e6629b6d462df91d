"""Trials of the arms and hands: reaching, poses by inverse kinematics, grasping, and carrying."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bench.robot.grasping import LIFT, READY, READY_TIME, SIDE, Grasp
from bench.robot.hand_goals import KnownGoal, known_goals
from bench.robot.reach import HandTarget
from bench.robot.trial import (
    Attempt,
    Run,
    Summary,
    Trial,
    mean,
    mean_and_max,
    simulate,
    summary,
    values_of,
)
from bench.robot.trial_humanoid import TrialHumanoid
from robot_sim.arms.inverse_kinematics import ArmInverseKinematics, Unreachable, rotation_vector
from robot_sim.arms.joint_trajectory import HOLD, JointTrajectory, Waypoint
from robot_sim.humanoid import Humanoid
from robot_sim.model.joint_names import arm_joints


class Reaches(Trial):
    """Bring the right hand to places in front of the robot, the waist helping."""

    SEED = 20265
    FARTHEST = 0.55  # m, from the shoulder
    CLOSE = 0.01  # m

    def cases(self, quick: bool) -> list[tuple[float, float, float]]:
        """Return places (x, y, z) m within reach of the right shoulder, in front of the body."""
        chance = random.Random(self.SEED)
        places: list[tuple[float, float, float]] = []
        while len(places) < (6 if quick else 41):
            place = chance.uniform(0.15, 0.55), chance.uniform(-0.55, 0.15), chance.uniform(0.65, 1.15)
            if math.dist(place, (0.0, -0.17, 0.98)) < self.FARTHEST:
                places.append(place)
        return places

    def attempt(self, case: tuple[float, float, float]) -> Attempt:
        """Reach for one place."""
        humanoid = TrialHumanoid()
        simulate(humanoid, 0.4)
        ready = Waypoint(READY_TIME, READY, (0.0,) * len(READY))
        humanoid.move_joints(JointTrajectory(tuple(arm_joints(SIDE)), (ready,)))
        simulate(humanoid, READY_TIME + 0.2)
        start = humanoid.time
        reach = humanoid.reach(SIDE, HandTarget(case, speed=0.5, with_waist=True))
        arrived = simulate(humanoid, 3.0, until=lambda: reach.error() < self.CLOSE)
        duration = humanoid.time - start
        simulate(humanoid, 1.0)
        error = reach.error()
        note = "" if arrived and error < self.CLOSE else f"{error:.3f} m away"
        return humanoid, note, {"error_m": error, "duration_s": duration}

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row."""
        row = summary(
            "reach ≤ 0.55 m from the shoulder, waist turning",
            runs,
            f"error {mean_and_max(values_of(runs, 'error_m'), 1)}; "
            f"mean {mean(values_of(runs, 'duration_s')):.2f} s",
            "39/41; mean 2 mm; 1.05 s",
            met=sum(run.success for run in runs) >= 0.95 * len(runs),
        )
        return [row]


class HandPoses(Trial):
    """Bring either hand to poses in odom by joint angles that the inverse kinematics found."""

    DURATION = 2.0  # s, of the motion
    REST_TIME = 1.0  # s
    CLOSE = 0.005, 0.01  # m, rad

    def cases(self, quick: bool) -> list[KnownGoal]:
        """Return goals of every kind, and some that are out of reach."""
        return known_goals(40 if quick else 200)

    def attempt(self, case: KnownGoal) -> Attempt:
        """Solve the inverse kinematics of one pose and move there, or expect that it is out of reach."""
        humanoid = Humanoid()
        simulate(humanoid, 0.5)
        base = humanoid.base_pose().position
        goal = replace(case.goal, balancing=True)
        try:
            posture = ArmInverseKinematics(humanoid.model).solve(humanoid.data, case.side, goal)
        except Unreachable as refusal:
            return humanoid, str(refusal) if case.reachable else "", {}
        if not case.reachable:
            return humanoid, "was found, though it is out of reach", {}
        end = Waypoint(self.DURATION, posture.positions, (0.0,) * len(posture.names))
        humanoid.move_joints(JointTrajectory(posture.names, (end,)))
        simulate(humanoid, self.DURATION + self.REST_TIME)
        hand = humanoid.hands[case.side]
        error = float(np.linalg.norm(hand.pose.position - base - goal.position))
        turn = 0.0
        if goal.rotation is not None:
            turn = float(np.linalg.norm(rotation_vector(hand.rotation, goal.rotation)))
        is_close = error < self.CLOSE[0] and turn < self.CLOSE[1]
        note = "" if is_close else f"{error:.3f} m and {turn:.3f} rad away"
        return humanoid, note, {"error_m": error, "turn_rad": turn}

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row; the runs that were rightly refused have no error to count."""
        moved = [run for run in runs if "error_m" in run.values]
        refused = sum(run.success for run in runs) - sum(run.success for run in moved)
        row = summary(
            "hand poses by inverse kinematics, both arms",
            runs,
            f"error {mean_and_max(values_of(moved, 'error_m'), 1)}; "
            f"{max(values_of(moved, 'turn_rad')):.3f} rad; {refused} out of reach",
            f"all within {1000 * self.CLOSE[0]:.0f} mm and {self.CLOSE[1]:g} rad, or rightly refused",
        )
        return [row]


class Grasps(Trial):
    """Take the cup, lift it, hold it, put it down elsewhere."""

    SEED = 20263
    HOLD_TIME = 2.0  # s

    def cases(self, quick: bool) -> list[tuple[float, float, float, float]]:
        """Return places (x, y) m of the cup, before and after."""
        ranges = (0.30, 0.38), (-0.28, -0.08), (0.30, 0.37), (-0.28, -0.05)
        chance = random.Random(self.SEED)
        draws = [[chance.uniform(*each) for each in ranges] for _ in range(4 if quick else 30)]
        return [(from_x, from_y, to_x, to_y) for from_x, from_y, to_x, to_y in draws]

    def attempt(self, case: tuple[float, float, float, float]) -> Attempt:
        """Move one cup."""
        from_x, from_y, to_x, to_y = case
        grasp = beside_a_cup_at(from_x, from_y)
        height = float(grasp.cup()[2])
        if problem := grasp.take():
            return grasp.robot, problem, {}
        slip, lowest, force = grasp.slip(), math.inf, 0.0
        for _ in range(20):
            simulate(grasp.robot, self.HOLD_TIME / 20)
            lowest = min(lowest, float(grasp.cup()[2]))
            force = max(force, *grasp.robot.hands[SIDE].forces)
        values = {"slip_m": slip(), "force_N": force}
        if lowest < height + LIFT - 0.03:
            return grasp.robot, f"dropped: the cup sank to {lowest - height:.3f} m above the table", values
        values["error_m"], wrong = grasp.put_down(to_x, to_y, height)
        return grasp.robot, wrong, values

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row."""
        row = summary(
            "grasp, lift 12 cm, hold 2 s, place",
            runs,
            f"place error {mean_and_max(values_of(runs, 'error_m'))}; "
            f"slip max {1000 * max(values_of(runs, 'slip_m')):.1f} mm; "
            f"{mean(values_of(runs, 'force_N')):.1f} N a finger; mean {mean(values_of(runs, 'duration_s')):.1f} s",
            "all; mean 2 mm; 14.6 N; 11.6 s",
        )
        return [row]


class Carries(Trial):
    """Walk to the table, take the cup, carry it away, turn, come back to another place, put it down."""

    SEED = 20264
    DISTANCE = 1.5  # m, from the table's edge region where the robot starts

    def cases(self, quick: bool) -> list[tuple[float, float, float]]:
        """Return where the cup stands, (x, y) m, and how far (m) to the side the robot stops at the table."""
        chance = random.Random(self.SEED)
        return [
            (chance.uniform(0.31, 0.36), chance.uniform(-0.24, -0.10), chance.uniform(-0.02, 0.02))
            for _ in range(2 if quick else 12)
        ]

    def attempt(self, case: tuple[float, float, float]) -> Attempt:
        """Carry the cup once."""
        x, y, offset = case
        grasp = beside_a_cup_at(x, y, -self.DISTANCE)
        robot = grasp.robot
        table = float(grasp.cup()[2])
        if not walk(robot, 0.03, offset, 0.0):
            return robot, "it did not arrive at the table", {}
        if problem := grasp.take():
            return robot, problem, {}
        robot.move_joints(HOLD)  # the hand travels with the body now
        slip = grasp.slip()
        if not (walk(robot, -0.45, 0.0, 0.0) and walk(robot, -1.0, 0.9, math.pi / 2)):
            return robot, "it did not arrive with the cup", {}
        values = {"slip_m": slip()}
        if values["slip_m"] > 0.02 or not grasp.holds():
            return robot, f"lost: the cup moved {values['slip_m']:.3f} m in the hand", values
        if not (walk(robot, -0.45, 0.0, 0.0) and walk(robot, 0.03, 0.0, 0.0)):
            return robot, "it did not come back to the table", values
        values["error_m"], wrong = grasp.put_down(0.33, -0.17, table)
        return robot, wrong, values

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row."""
        row = summary(
            "walk to the table, grasp, carry, turn, put down",
            runs,
            f"slip max {1000 * max(values_of(runs, 'slip_m')):.1f} mm; "
            f"place error {mean_and_max(values_of(runs, 'error_m'))}; "
            f"mean {mean(values_of(runs, 'duration_s')):.1f} s",
            "12/12 (carried, not put down)",
        )
        return [row]


def beside_a_cup_at(x: float, y: float, start: float = 0.0) -> Grasp:
    """Return the hand of a robot that stands at `start` (m, along x), and the cup at (x, y) m on the table."""
    humanoid = TrialHumanoid("table")
    humanoid.reset(x=start)
    humanoid.data.joint("cup").qpos[:2] = x, y
    simulate(humanoid, 0.5)
    return Grasp(humanoid)


def walk(robot: TrialHumanoid, x: float, y: float, yaw: float) -> bool:
    """Walk to a pose; return whether the robot arrived."""
    robot.walk_to(x, y, yaw)
    arrived = simulate(robot, 25.0, until=lambda: robot.arrived)
    simulate(robot, 0.6)
    return arrived
