"""Trials of balance: pushes, floors that are not flat, an estimated state, and crouching."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

from bench.robot.floor import Floor
from bench.robot.height_change import HeightChange, HeightPhase
from bench.robot.trial import (
    Attempt,
    Run,
    Summary,
    Trial,
    feet_midpoint,
    has_fallen,
    mean,
    mean_and_max,
    simulate,
    summary,
    values_of,
)
from bench.robot.trial_humanoid import TrialHumanoid
from robot_sim.humanoid import Humanoid

TIME_LIMIT = 30.0  # s, for a walk


def polar(size: float, direction: float) -> tuple[float, float, float]:
    """Return a horizontal vector of this size in a direction (rad)."""
    return size * math.cos(direction), size * math.sin(direction), 0.0


class Pushes(Trial):
    """Push the torso from any direction, standing and walking, and from the side, where walking is weakest."""

    DURATION = 0.1  # s
    GAITS = ("standing", "walking", "walking, from the side")
    REFERENCE: ClassVar = {  # survivals of 32 for each gait, with 10, 14, 18 N·s
        "humanoid": ((32, 32, 31), (31, 27, 20), (29, 29)),
        "g1": ((32, 32, 32), (32, 32, 32), (32, 32, 32)),
    }

    def __init__(self, robot: str = "humanoid") -> None:
        self._robot = robot
        self._reference = {
            (gait, impulse): survivals
            for gait, of_impulses in zip(self.GAITS, self.REFERENCE[robot], strict=True)
            for impulse, survivals in zip((10, 14, 18), of_impulses, strict=False)
        }

    def cases(self, quick: bool) -> list[tuple[str, int, int]]:
        """Return gait, impulse (N·s) and seed."""
        return [
            (gait, impulse, seed)
            for gait, impulse in self._reference
            for seed in range(32)
            if not quick or (seed < 6 and impulse == 10)
        ]

    def attempt(self, case: tuple[str, int, int]) -> Attempt:
        """Push once at a random moment from a random direction; it survives if it is up four seconds later."""
        gait, impulse, seed = case
        chance = random.Random(seed)
        humanoid = Humanoid(robot=self._robot)
        simulate(humanoid, 0.5)
        if gait.startswith("walking"):
            humanoid.walk_velocity(0.25, 0.0, 0.0)
        simulate(humanoid, chance.uniform(1.5, 2.5))
        direction = chance.uniform(-math.pi, math.pi)
        if gait.endswith("side"):
            direction = math.copysign(math.pi / 2, direction)
        humanoid.push(polar(impulse, direction), self.DURATION)
        simulate(humanoid, 4.0)
        fell = f"fell, pushed towards {math.degrees(direction):.0f}°"
        return humanoid, fell if has_fallen(humanoid) else "", {}

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row for each gait and impulse."""
        groups = {kind: [run for run in runs if run.case[:2] == kind] for kind in self._reference}
        return [
            share_of(
                f"{self._robot}: push {kind[1]} N·s in {self.DURATION} s, {kind[0]}",
                group,
                "stay up",
                of_32,
                32,
            )
            for (kind, of_32), group in zip(self._reference.items(), groups.values(), strict=True)
            if group
        ]


class Terrain(Trial):
    """Walk over floors that are not flat: slopes in every direction, and bumps strewn over the way."""

    DISTANCE = 2.0  # m
    BUMPS_A_SQUARE_METRE = 12
    CLEAR = 0.3  # m around the feet at the start
    REFERENCE: ClassVar = {  # runs of 24 that arrive, for slopes in degrees and bumps in m
        ("slope", 2.0): 24,
        ("slope", 3.0): 24,
        ("slope", 5.0): 24,
        ("bumps", 0.005): 24,
        ("bumps", 0.010): 24,
    }

    def cases(self, quick: bool) -> list[tuple[str, float, int]]:
        """Return kind of floor, slope (degrees) or height (m), and a seed."""
        return [(kind, size, seed) for kind, size in self.REFERENCE for seed in range(2 if quick else 24)]

    def attempt(self, case: tuple[str, float, int]) -> Attempt:
        """Walk two metres in some direction and stand there."""
        kind, size, seed = case
        chance = random.Random(f"{kind}/{size}/{seed}")
        direction, uphill = chance.uniform(-math.pi, math.pi), chance.uniform(-math.pi, math.pi)
        bumpy = kind == "bumps"
        floor = Floor(bumps=self._strewn(chance, size)) if bumpy else Floor(math.radians(size), uphill)
        humanoid = Humanoid(shape=floor.shape)
        simulate(humanoid, 1.0)
        x, y, _ = polar(self.DISTANCE, direction)
        humanoid.walk_to(x, y, direction)
        arrived = simulate(humanoid, TIME_LIMIT, until=lambda: humanoid.arrived)
        simulate(humanoid, 1.0)
        return humanoid, "" if arrived else f"not there after {TIME_LIMIT:g} s", {}

    def _strewn(self, chance: random.Random, height: float) -> tuple[tuple[float, float, float], ...]:
        """Return bumps everywhere but under the feet."""
        reach = self.DISTANCE + 0.5
        places = [
            (chance.uniform(-reach, reach), chance.uniform(-reach, reach))
            for _ in range(round(self.BUMPS_A_SQUARE_METRE * 4 * reach**2))
        ]
        return tuple((x, y, height) for x, y in places if math.hypot(x, y) > self.CLEAR)

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row for each floor."""
        rows = []
        for (kind, size), of_24 in self.REFERENCE.items():
            group = [run for run in runs if run.case[:2] == (kind, size)]
            slope = f"slope of {size:g}°, any direction"
            title = slope if kind == "slope" else f"bumps of {1000 * size:g} mm"
            rows.append(share_of(title, group, f"arrive after {self.DISTANCE:g} m", of_24, 24))
        return rows


def share_of(title: str, runs: Sequence[Run], verb: str, expected: int, out_of: int) -> Summary:
    """Return a row that counts the runs that succeed, and expects at least the share of the reference."""
    succeeded = sum(run.success for run in runs)
    met = succeeded / len(runs) >= expected / out_of
    return summary(title, runs, f"{succeeded}/{len(runs)} {verb}", f"{expected}/{out_of}", met=met)


class Estimates(Trial):
    """Walk and be pushed with the state estimated from IMU, encoders and contacts instead of the ground truth."""

    SEED = 20265
    CALIBRATION = 1.0  # s, of standing, in which the gyro's bias is learnt
    PUSH = 10.0  # N·s
    GOAL, PUSHED = "goal", "push"

    def cases(self, quick: bool) -> list[tuple[str, float, float, float, int]]:
        """Return kind, goal (x m, y m, yaw rad) or push (x, y N·s, moment s), and the seed of the sensors."""
        chance = random.Random(self.SEED)
        runs = 3 if quick else 32
        goals = [
            (self.GOAL, chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(-math.pi, math.pi), seed)
            for seed in range(runs)
        ]
        pushes = [polar(self.PUSH, chance.uniform(-math.pi, math.pi))[:2] for _ in range(runs)]
        return goals + [
            (self.PUSHED, x, y, chance.uniform(1.5, 2.5), seed) for seed, (x, y) in enumerate(pushes)
        ]

    def attempt(self, case: tuple[str, float, float, float, int]) -> Attempt:
        """Walk once."""
        kind, x, y, other, seed = case
        humanoid = TrialHumanoid(seed=seed, estimates_state=True)
        simulate(humanoid, self.CALIBRATION)
        if kind == self.PUSHED:
            humanoid.walk_velocity(0.25, 0.0, 0.0)
            simulate(humanoid, other)
            humanoid.push((x, y, 0.0))
            simulate(humanoid, 4.0)
            return humanoid, "", {}
        humanoid.walk_to(x, y, other)
        arrived = simulate(humanoid, TIME_LIMIT, until=lambda: humanoid.arrived)
        simulate(humanoid, 1.0)
        note = "" if arrived else f"not there after {TIME_LIMIT:g} s"
        return humanoid, note, {"error_m": math.dist(feet_midpoint(humanoid), (x, y))}

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row for the goals and one for the pushes."""
        goals = [run for run in runs if run.case[0] == self.GOAL]
        pushes = [run for run in runs if run.case[0] == self.PUSHED]
        error = values_of(goals, "error_m")
        there = summary(
            "state estimated: goals within 2 m",
            goals,
            f"true error {mean_and_max(error)}",
            "all, within 0.10 m",
            met=all(run.success for run in goals) and max(error) < 0.10,
        )
        pushed = share_of(f"state estimated: push {self.PUSH:g} N·s, walking", pushes, "stay up", 31, 32)
        return [there, replace(pushed, reference=f"{pushed.reference}, as with the ground truth")]


class Crouches(Trial):
    """Crouch and rise, at a commanded rate and in phases, be pushed meanwhile, walk on."""

    SEED = 20266
    STANCE = 0.60  # m, height of the pelvis
    TOLERANCE = 0.01  # m
    RATE, PHASES, PUSHED = "rate", "phases", "phases, pushed"
    IMPULSE: ClassVar = {RATE: 8.0, PHASES: 0.0, PUSHED: 10.0}  # N·s
    WAY = (HeightPhase.SHIFTING, HeightPhase.LOWERING, HeightPhase.RISING, HeightPhase.SETTLING)

    def cases(self, quick: bool) -> list[tuple[str, float, float, float]]:
        """Return kind, height (m) of the crouch, direction (rad) of the push, and its moment (s after the rise)."""
        runs = 4 if quick else 24
        chance = random.Random(self.SEED)
        places = [(chance.uniform(0.45, 0.52), chance.uniform(-math.pi, math.pi)) for _ in range(runs)]
        moments = [chance.uniform(0.2, 1.4) for _ in range(runs)]
        return [
            (kind, *place, moment if kind == self.PUSHED else 0.0)
            for kind in self.IMPULSE
            for place, moment in zip(places, moments, strict=True)
        ]

    def attempt(self, case: tuple[str, float, float, float]) -> Attempt:
        """Crouch, rise, and walk half a metre."""
        kind, height, direction, moment = case
        humanoid = TrialHumanoid()
        push = polar(self.IMPULSE[kind], direction)
        problem, values = "", dict[str, float]()
        if kind == self.RATE:
            self._rise_at_a_rate(humanoid, height, push)
        else:
            problem, values = self._rise_in_phases(humanoid, height, push, moment)
        error = abs(float(humanoid.base_pose().position[2]) - self.STANCE)
        humanoid.walk_to(0.5, 0.0, 0.0)
        arrived = simulate(humanoid, 15.0, until=lambda: humanoid.arrived)
        if not problem and error > self.TOLERANCE:
            problem = f"rose to within {error:.3f} m"
        return humanoid, problem or ("" if arrived else "did not walk on"), {"error_m": error, **values}

    @staticmethod
    def _rise_at_a_rate(humanoid: TrialHumanoid, height: float, push: Sequence[float]) -> None:
        """Get a push in the crouch, then rise at a rate as with cmd_vel."""
        humanoid.reset(height=height)
        simulate(humanoid, 0.5)
        humanoid.push(push)
        simulate(humanoid, 2.5)
        humanoid.move_body(0.1)
        simulate(humanoid, 2.5)

    def _rise_in_phases(
        self, humanoid: TrialHumanoid, height: float, push: Sequence[float], moment: float
    ) -> tuple[str, dict[str, float]]:
        """Crouch, rise and be pushed; return the problem, the seconds in each phase, and the repeated shifts."""
        simulate(humanoid, 0.5)
        times = dict.fromkeys((phase.value for phase in self.WAY), 0.0)
        crouch = humanoid.crouch_to(height)
        self._watch(humanoid, crouch, times)
        rise = humanoid.stand_up()
        self._watch(humanoid, rise, times, until=humanoid.time + moment)
        humanoid.push(push)
        again = self._watch(humanoid, rise, times)
        return crouch.problem or rise.problem, {**times, "again": again}

    @staticmethod
    def _watch(
        humanoid: TrialHumanoid, change: HeightChange, times: dict[str, float], until: float = math.inf
    ) -> float:
        """Step until a change has ended; add up the time of its phases and count how often it shifted again."""
        again = 0
        while not change.phase.is_last and humanoid.time < until:
            before = change.phase
            humanoid.step()
            times[before.value] += humanoid.timestep
            again += change.phase is HeightPhase.SHIFTING and before is not HeightPhase.SHIFTING
        return float(again)

    def summarize(self, runs: Sequence[Run]) -> list[Summary]:
        """Return one row for each kind."""
        titles = {
            self.RATE: f"crouch, {self.IMPULSE[self.RATE]:g} N·s, rise, walk on",
            self.PHASES: "crouch and stand up in phases, walk on",
            self.PUSHED: f"the same, {self.IMPULSE[self.PUSHED]:g} N·s while it stands up",
        }
        rows = []
        for kind, title in titles.items():
            group = [run for run in runs if run.case[0] == kind]
            measured = f"stance reached within {1000 * max(values_of(group, 'error_m')):.1f} mm"
            if kind != self.RATE:
                phases = (f"{phase.value} {mean(values_of(group, phase.value)):.2f} s" for phase in self.WAY)
                again = sum(run.values["again"] > 0 for run in group)
                measured += f"; mean {', '.join(phases)}; {again} shifted anew"
            rows.append(summary(title, group, measured, "all"))
        return rows
