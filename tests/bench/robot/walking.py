"""Trials of walking: goals, limits, stops, a student's controller, and random commands."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from typing import ClassVar

from bench.robot.trial import (
    Attempt,
    Run,
    Summary,
    Trial,
    base_speed,
    feet_midpoint,
    has_fallen,
    mean,
    mean_and_max,
    simulate,
    summary,
    values_of,
)
from robot_sim.humanoid import Humanoid
from robot_sim.model.side import SIDES
from robot_sim.walking.planar import clamp
from robot_sim.walking.walking_limits import WalkingLimits
from ros_runtime.angles import wrap

TIME_LIMIT = 30.0  # s, for a goal
SERVO_TIME_LIMIT = 60.0  # s
STOPPED = 0.05  # m/s

Pose = tuple[float, float, float]
Twist = tuple[float, float, float]


def standing() -> Humanoid:
    """Return a robot half a second after its start."""
    humanoid = Humanoid()
    simulate(humanoid, 0.5)
    return humanoid


class Goals(Trial):
    """Walk to poses around the robot."""

    SEED = 20260

    def cases(self, quick: bool) -> list[Pose]:
        """Return goals (x m, y m, yaw rad) within 2 m to each side, with any heading."""
        chance = random.Random(self.SEED)
        return [
            (chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(-math.pi, math.pi))
            for _ in range(8 if quick else 60)
        ]

    def attempt(self, case: Pose) -> Attempt:
        """Walk to one goal and stand there."""
        humanoid = standing()
        start = humanoid.time
        humanoid.walk_to(*case)
        arrived = simulate(humanoid, TIME_LIMIT, until=lambda: humanoid.arrived)
        duration = humanoid.time - start
        simulate(humanoid, 1.5)
        left, right = (humanoid.data.site(f"{side.letter}_sole") for side in SIDES)
        facing = (left.xmat + right.xmat).tolist()
        values = {
            "error_m": math.dist(case[:2], feet_midpoint(humanoid)),
            "yaw_error_rad": abs(wrap(case[2] - math.atan2(facing[3], facing[0]))),
            "duration_s": duration,
        }
        return humanoid, "" if arrived else f"not there after {TIME_LIMIT:g} s", values

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row."""
        error, yaw_error = values_of(runs, "error_m"), max(values_of(runs, "yaw_error_rad"))
        row = summary(
            "goals within 2 m, any heading",
            runs,
            f"error {mean_and_max(error)}; "
            f"yaw max {yaw_error:.3f} rad; mean {mean(values_of(runs, 'duration_s')):.1f} s",
            "all; mean 3 mm, max 19 mm; yaw ≤ 0.05 rad; mean 7.2 s",
            met=all(run.success for run in runs) and max(error) < 0.03 and yaw_error < 0.06,
        )
        return [row]


class Limits(Trial):
    """Command far more velocity than the robot can walk, in each direction, then stop."""

    LIMITS = WalkingLimits()
    REFERENCE: ClassVar = {  # the command (m/s, m/s, rad/s) and what is advertised for it, by name
        "ahead": ((5.0, 0.0, 0.0), LIMITS.forward),
        "back": ((-5.0, 0.0, 0.0), LIMITS.backward),
        "sideways": ((0.0, 5.0, 0.0), LIMITS.sideways),
        "turning": ((0.0, 0.0, 5.0), LIMITS.turn),
    }
    STEPS = 10  # that are measured
    STEP_TIME = 0.44  # s
    MAX_ERROR_RATIO = 0.1  # of the limit

    def cases(self, quick: bool) -> list[str]:
        """Return the directions."""
        return list(self.REFERENCE)

    def attempt(self, case: str) -> Attempt:
        """Walk at the limit for ten steps and stop."""
        command, limit = self.REFERENCE[case]
        humanoid = Humanoid()
        humanoid.walk_velocity(*command)
        simulate(humanoid, 2.0)
        start = last = humanoid.base_pose()
        turned = 0.0
        for _ in range(self.STEPS):
            simulate(humanoid, self.STEP_TIME)
            pose = humanoid.base_pose()
            turned += wrap(pose.yaw - last.yaw)
            last = pose
        moved = abs(turned) if case == "turning" else self._distance(start, last)
        humanoid.stop()
        stopped = simulate(humanoid, 3.0, until=lambda: base_speed(humanoid) < STOPPED)
        speed = moved / (self.STEPS * self.STEP_TIME)
        as_advertised = stopped and abs(speed / limit - 1) < self.MAX_ERROR_RATIO
        note = "" if as_advertised else f"{speed:.3f} instead of {limit:g}"
        return humanoid, note, {"speed": speed, "stop_m": self._distance(last, humanoid.base_pose())}

    @staticmethod
    def _distance(start, end) -> float:
        return math.hypot(*(end.position - start.position)[:2])

    @staticmethod
    def _unit(way: str) -> str:
        return "rad/s" if way == "turning" else "m/s"

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row."""
        measured = "; ".join(
            f"{run.case} {run.values['speed']:.2f} {self._unit(run.case)}, "
            f"stops after {run.values['stop_m']:.2f} m"
            for run in runs
        )
        reference = "; ".join(
            f"{way} {limit:g} {self._unit(way)}" for way, (_, limit) in self.REFERENCE.items()
        )
        return [summary("commands beyond the limits", runs, measured, reference)]


class Speeds(Trial):
    """Command velocities that a robot can walk at, and measure what it walks: the same for every robot."""

    ASKED: ClassVar = {  # m/s, m/s, rad/s
        "ahead": ((0.1, 0.0, 0.0), (0.25, 0.0, 0.0), (0.4, 0.0, 0.0)),
        "back": ((-0.2, 0.0, 0.0),),
        "left": ((0.0, 0.1, 0.0),),
        "turning": ((0.0, 0.0, 0.4),),
    }
    AXIS: ClassVar = {"ahead": 0, "back": 0, "left": 1, "turning": 2}
    MEASURED_TIME = 10.0  # s
    MAX_ERROR_RATIO = 0.15  # of the velocity

    def __init__(self, robot: str) -> None:
        self._robot = robot

    def cases(self, quick: bool) -> list[tuple[str, Twist]]:
        """Return directions and velocities."""
        return [(way, twist) for way, twists in self.ASKED.items() for twist in twists]

    def attempt(self, case: tuple[str, Twist]) -> Attempt:
        """Walk for 2 s, then measure."""
        way, twist = case
        humanoid = Humanoid(robot=self._robot)
        humanoid.walk_velocity(*twist)
        simulate(humanoid, 2.0)
        forward = left = turned = 0.0
        last = humanoid.base_pose()
        for _ in range(round(self.MEASURED_TIME / 0.02)):
            simulate(humanoid, 0.02)
            pose = humanoid.base_pose()
            dx, dy = (pose.position - last.position)[:2].tolist()
            forward += math.cos(pose.yaw) * dx + math.sin(pose.yaw) * dy
            left += math.cos(pose.yaw) * dy - math.sin(pose.yaw) * dx
            turned += wrap(pose.yaw - last.yaw)
            last = pose
        asked = twist[self.AXIS[way]]
        walked = (forward, left, turned)[self.AXIS[way]] / self.MEASURED_TIME
        fair = abs(walked - asked) <= self.MAX_ERROR_RATIO * abs(asked)
        return humanoid, "" if fair else f"walked {walked:.3f}", {"asked": asked, "walked": walked}

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row for each direction."""
        rows = []
        for way in self.ASKED:
            ours = [run for run in runs if run.case[0] == way]
            pairs = ", ".join(f"{run.values['asked']:g} → {run.values['walked']:.2f}" for run in ours)
            unit = "rad/s" if way == "turning" else "m/s"
            title = f"{self._robot}: asked and walked, {way}"
            rows.append(summary(title, ours, f"{pairs} {unit}", f"within {self.MAX_ERROR_RATIO:.0%}"))
        return rows


class Stops(Trial):
    """Stop at a random moment of a random walk."""

    FIRST_SEED = 7000
    ALLOWED = 2.0  # s

    def cases(self, quick: bool) -> list[int]:
        """Return seeds."""
        return [self.FIRST_SEED + index for index in range(12 if quick else 60)]

    def attempt(self, case: int) -> Attempt:
        """Walk for a while, stop, and watch the pelvis for four seconds."""
        chance = random.Random(case)
        humanoid = standing()
        if chance.random() < 0.5:
            humanoid.walk_velocity(
                chance.uniform(-0.2, 0.45), chance.uniform(-0.12, 0.12), chance.uniform(-0.45, 0.45)
            )
        else:
            humanoid.walk_to(chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(-3, 3))
        simulate(humanoid, chance.uniform(0.1, 4.0))
        start_x, start_y, _ = humanoid.base_pose().position
        stop = last_moving = humanoid.time
        if chance.random() < 0.5:
            humanoid.stop()
        else:
            humanoid.walk_velocity(0.0, 0.0, 0.0)
        for _ in range(round(4.0 / humanoid.timestep)):
            humanoid.step()
            if base_speed(humanoid) >= STOPPED:
                last_moving = humanoid.time
        x, y, _ = humanoid.base_pose().position
        settling = last_moving - stop
        note = f"took {settling:.2f} s" if settling > self.ALLOWED else ""
        return humanoid, note, {"settling_s": settling, "travel_m": math.hypot(x - start_x, y - start_y)}

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row."""
        settling, travel = values_of(runs, "settling_s"), values_of(runs, "travel_m")
        row = summary(
            f"stop mid-walk, base < {STOPPED} m/s within {self.ALLOWED:g} s",
            runs,
            f"mean {mean(settling):.2f} s, max {max(settling):.2f} s; "
            f"travel mean {mean(travel):.2f} m, max {max(travel):.2f} m",
            "all; mean 0.48 s, max 0.92 s; travel mean 0.07 m, max 0.20 m",
            met=all(run.success for run in runs) and max(settling) < 1.2,
        )
        return [row]


class Servo(Trial):
    """A proportional controller on odometry over velocity commands, as a student writes it."""

    SEED = 4100
    RATES = (10, 20)  # Hz
    STYLES = ("holonomic", "turn, walk, turn")
    STOP_AT = 0.05, 0.10  # m, rad; where the controller is content
    SUCCESS = 0.10, 0.15  # m, rad; where the robot must stand in the end

    def cases(self, quick: bool) -> list[tuple[str, int, Pose]]:
        """Return style, rate and goal (base_link in odom) within 2 m, with any heading."""
        chance = random.Random(self.SEED)
        goals = []
        for _ in range(3 if quick else 30):
            distance, direction = chance.uniform(0.2, 2.0), chance.uniform(-math.pi, math.pi)
            x, y = distance * math.cos(direction), distance * math.sin(direction)
            goals.append((x, y, chance.uniform(-math.pi, math.pi)))
        return [(style, rate, goal) for style in self.STYLES for rate in self.RATES for goal in goals]

    def attempt(self, case: tuple[str, int, Pose]) -> Attempt:
        """Servo to one goal, stop, and see where the robot stands."""
        style, rate, goal = case
        control = holonomic if style == "holonomic" else TurnWalkTurn()
        humanoid = standing()
        start = humanoid.time
        while humanoid.time - start < SERVO_TIME_LIMIT and not has_fallen(humanoid):
            error = pose_error(humanoid, goal)
            if math.hypot(error[0], error[1]) < self.STOP_AT[0] and abs(error[2]) < self.STOP_AT[1]:
                break
            humanoid.walk_velocity(*control(error))
            simulate(humanoid, 1.0 / rate)
        duration = humanoid.time - start
        humanoid.walk_velocity(0.0, 0.0, 0.0)
        simulate(humanoid, 2.0)
        x, y, yaw = pose_error(humanoid, goal)
        distance, note = math.hypot(x, y), ""
        if duration >= SERVO_TIME_LIMIT:
            note = f"not there after {SERVO_TIME_LIMIT:g} s: {distance:.2f} m, {yaw:.2f} rad away"
        elif distance > self.SUCCESS[0] or abs(yaw) > self.SUCCESS[1]:
            note = f"stands {distance:.2f} m, {yaw:.2f} rad away"
        return humanoid, note, {"error_m": distance, "yaw_error_rad": abs(yaw), "duration_s": duration}

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row for each style and rate."""
        return [
            self._row(style, rate, [run for run in runs if run.case[:2] == (style, rate)])
            for style in self.STYLES
            for rate in self.RATES
        ]

    def _row(self, style: str, rate: int, runs: Sequence[Run]) -> Summary:
        return summary(
            f"P controller over cmd_vel, {rate} Hz, {style}",
            runs,
            f"error {mean_and_max(values_of(runs, 'error_m'))}; yaw max "
            f"{max(values_of(runs, 'yaw_error_rad')):.3f} rad; mean {mean(values_of(runs, 'duration_s')):.1f} s",
            f"all within {self.SUCCESS[0]:.2f} m and {self.SUCCESS[1]:.2f} rad",
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


class Soak(Trial):
    """Goals, velocities and stops at random, each interrupting the one before."""

    def cases(self, quick: bool) -> list[tuple[int, float]]:
        """Return seed and length (simulated s)."""
        return [(300 + index, 45.0 if quick else 600.0) for index in range(2 if quick else 4)]

    def attempt(self, case: tuple[int, float]) -> Attempt:
        """Command at random for the whole length; a fallen robot is stood up again and counted."""
        seed, length = case
        chance = random.Random(seed)
        humanoid = Humanoid()
        simulated, falls, commands, fell_at = 0.0, 0, 0, ""
        while simulated < length:
            command = command_at_random(humanoid, chance)
            commands += 1
            before = humanoid.time
            simulate(humanoid, chance.uniform(0.3, 8.0))
            simulated += humanoid.time - before
            if has_fallen(humanoid):
                falls += 1
                fell_at = command
                humanoid.reset()
        note = f"{falls} falls in {commands} commands, the last at {fell_at}" if falls else ""
        return humanoid, note, {"falls": falls, "simulated_s": simulated}

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row."""
        falls = sum(int(run.values["falls"]) for run in runs)
        minutes = sum(run.values["simulated_s"] for run in runs) / 60
        measured = f"{falls} falls in {minutes:.1f} simulated min"
        return [summary("random commands, pre-empted every 0.3-8 s", runs, measured, "0 falls in 40 min")]


def command_at_random(humanoid: Humanoid, chance: random.Random) -> str:
    """Give the robot a command; return it in words."""
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
