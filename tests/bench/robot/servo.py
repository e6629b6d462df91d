"""A proportional controller on odometry over velocity commands, as a student writes it."""

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
    has_fallen,
    mean,
    simulate,
    summary,
    values_of,
)
from robot_sim.humanoid import Humanoid
from robot_sim.walking.planar import clamp
from ros_runtime.angles import wrap

SEED = 4100
RATES = (10, 20)  # Hz
STYLES = ("holonomic", "turn, walk, turn")
TIME_LIMIT = 60.0  # s
STOP_AT = 0.05, 0.10  # m, rad; where the controller is content
SUCCESS = 0.10, 0.15  # m, rad; where the robot must stand in the end

Pose = tuple[float, float, float]
Twist = tuple[float, float, float]


def cases(quick: bool) -> list[tuple[str, int, Pose]]:
    """Return style, rate and goal (base_link in odom) within 2 m, with any heading."""
    chance = random.Random(SEED)
    goals = []
    for _ in range(3 if quick else 30):
        distance, direction = chance.uniform(0.2, 2.0), chance.uniform(-math.pi, math.pi)
        goals.append(
            (
                distance * math.cos(direction),
                distance * math.sin(direction),
                chance.uniform(-math.pi, math.pi),
            )
        )
    return [(style, rate, goal) for style in STYLES for rate in RATES for goal in goals]


def run(case: tuple[str, int, Pose]) -> Run:
    """Servo to one goal, stop, and see where the robot stands."""
    style, rate, goal = case
    control = holonomic if style == "holonomic" else TurnWalkTurn()
    clock = Clock()
    humanoid = Humanoid()
    simulate(humanoid, 0.5)
    start = humanoid.time
    while humanoid.time - start < TIME_LIMIT and not has_fallen(humanoid):
        error = pose_error(humanoid, goal)
        if math.hypot(error[0], error[1]) < STOP_AT[0] and abs(error[2]) < STOP_AT[1]:
            break
        humanoid.walk_velocity(*control(error))
        simulate(humanoid, 1.0 / rate)
    duration = humanoid.time - start
    humanoid.walk_velocity(0.0, 0.0, 0.0)
    simulate(humanoid, 2.0)
    x, y, yaw = pose_error(humanoid, goal)
    distance = math.hypot(x, y)
    if has_fallen(humanoid):
        note = "fell"
    elif duration >= TIME_LIMIT:
        note = f"not there after {TIME_LIMIT:g} s: {distance:.2f} m, {yaw:.2f} rad away"
    elif distance > SUCCESS[0] or abs(yaw) > SUCCESS[1]:
        note = f"stands {distance:.2f} m, {yaw:.2f} rad away"
    else:
        note = ""
    return Run(
        case=(style, rate, tuple(round(number, 2) for number in goal)),
        success=not note,
        note=note,
        values={"error_m": distance, "yaw_error_rad": abs(yaw), "duration_s": duration},
        simulated=humanoid.time,
        cpu=clock.read(),
    )


def pose_error(humanoid: Humanoid, goal: Pose) -> Pose:
    """Return the goal as seen from base_link: forward and left (m), turn (rad)."""
    pose = humanoid.base_pose()
    dx, dy = goal[0] - pose.position[0], goal[1] - pose.position[1]
    cos, sin = math.cos(pose.yaw), math.sin(pose.yaw)
    return cos * dx + sin * dy, cos * dy - sin * dx, wrap(goal[2] - pose.yaw)


def holonomic(error: Pose) -> Twist:
    """Return a velocity with every component proportional to its error."""
    forward, left, turn = error
    return clamp(0.8 * forward, -0.2, 0.4), clamp(0.8 * left, -0.12, 0.12), clamp(turn, -0.45, 0.45)


class TurnWalkTurn:
    """Face the goal in place, walk to it, turn to its heading; ignore small errors once there."""

    def __init__(self) -> None:
        self._there = False

    def __call__(self, error: Pose) -> Twist:
        """Return the velocity for an error in base_link (m, m, rad)."""
        forward, left, turn = error
        distance, bearing = math.hypot(forward, left), math.atan2(left, forward)
        self._there = distance < (0.08 if self._there else 0.04)
        if self._there:
            return 0.0, 0.0, clamp(turn, -0.45, 0.45)
        if abs(bearing) > 0.3 and distance > 0.15:
            return 0.0, 0.0, clamp(bearing, -0.45, 0.45)
        if distance > 0.15:
            return clamp(0.8 * distance, 0.0, 0.4), 0.0, clamp(bearing, -0.45, 0.45)
        return clamp(0.8 * forward, -0.1, 0.1), clamp(0.8 * left, -0.1, 0.1), 0.0


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row for each style and rate."""
    rows = []
    for style in STYLES:
        for rate in RATES:
            group = [run for run in runs if run.case[:2] == (style, rate)]
            error, yaw_error = values_of(group, "error_m"), values_of(group, "yaw_error_rad")
            duration = values_of(group, "duration_s")
            rows.append(
                summary(
                    f"P controller over cmd_vel, {rate} Hz, {style}",
                    group,
                    measured=f"error mean {1000 * mean(error):.0f} mm, max {1000 * max(error):.0f} mm; "
                    f"yaw max {max(yaw_error):.3f} rad; mean {mean(duration):.1f} s",
                    reference=f"all within {SUCCESS[0]:.2f} m and {SUCCESS[1]:.2f} rad",
                    met=all_succeeded(group),
                )
            )
    return rows


TRIAL = Trial(cases, run, summarize)
