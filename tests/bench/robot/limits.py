"""Measure the walking limits: command far more velocity than the robot can walk, in each direction, then stop."""

from __future__ import annotations

import math
from collections.abc import Sequence

from bench.robot.trial import Clock, Run, Summary, Trial, base_speed, run_of, simulate, summary
from robot_sim.humanoid import Humanoid
from robot_sim.walking.walking_limits import WalkingLimits
from ros_runtime.angles import wrap

LIMITS = WalkingLimits()
REFERENCE = {  # the command (m/s, m/s, rad/s) and what is advertised for it, by name
    "ahead": ((5.0, 0.0, 0.0), LIMITS.forward),
    "back": ((-5.0, 0.0, 0.0), LIMITS.backward),
    "sideways": ((0.0, 5.0, 0.0), LIMITS.sideways),
    "turning": ((0.0, 0.0, 5.0), LIMITS.turn),
}
UNITS = {"turning": "rad/s"}
STEPS = 10  # that are measured
STEP_TIME = 0.44  # s
STOPPED = 0.05  # m/s
MAX_ERROR_RATIO = 0.1  # of the limit


def cases(quick: bool) -> list[str]:
    """Return the directions."""
    return list(REFERENCE)


def run(way: str) -> Run:
    """Walk at the limit for ten steps and stop."""
    clock = Clock()
    command, limit = REFERENCE[way]
    humanoid = Humanoid()
    humanoid.walk_velocity(*command)
    simulate(humanoid, 2.0)
    start = last = humanoid.base_pose()
    turned = 0.0
    for _ in range(STEPS):
        simulate(humanoid, STEP_TIME)
        pose = humanoid.base_pose()
        turned += wrap(pose.yaw - last.yaw)
        last = pose
    moved = abs(turned) if way == "turning" else _distance(start, last)
    humanoid.stop()
    stopped = simulate(humanoid, 3.0, until=lambda: base_speed(humanoid) < STOPPED)
    speed = moved / (STEPS * STEP_TIME)
    as_advertised = stopped and abs(speed / limit - 1) < MAX_ERROR_RATIO
    note = "" if as_advertised else f"{speed:.3f} instead of {limit:g}"
    stop = _distance(last, humanoid.base_pose())
    return run_of((way,), humanoid, clock, note, {"speed": speed, "stop_m": stop})


def _distance(start, end) -> float:
    return math.hypot(*(end.position - start.position)[:2])


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row."""
    measured = "; ".join(
        f"{way} {run.values['speed']:.2f} {UNITS.get(way, 'm/s')}, stops after {run.values['stop_m']:.2f} m"
        for run in runs
        for way in run.case
    )
    reference = "; ".join(f"{way} {limit:g} {UNITS.get(way, 'm/s')}" for way, (_, limit) in REFERENCE.items())
    return [
        summary("commands beyond the limits", runs, measured, reference, met=all(run.success for run in runs))
    ]


TRIAL = Trial(cases, run, summarize)
