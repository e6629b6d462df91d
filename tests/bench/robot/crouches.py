"""Crouch and rise, at a commanded rate and in phases, be pushed meanwhile, walk on."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from bench.robot.height_change import HeightChange, HeightPhase
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

SEED = 20266
STANCE = 0.60  # m, height of the pelvis
TOLERANCE = 0.01  # m

RATE, PHASES, PUSHED = "rate", "phases", "phases, pushed"
IMPULSE = {RATE: 8.0, PHASES: 0.0, PUSHED: 10.0}  # N·s
WAY = (HeightPhase.SHIFTING, HeightPhase.LOWERING, HeightPhase.RISING, HeightPhase.SETTLING)


def cases(quick: bool) -> list[tuple[str, float, float, float]]:
    """Return kind, height (m) of the crouch, direction (rad) of the push, and its moment (s after the rise)."""
    runs = 4 if quick else 24
    chance = random.Random(SEED)
    places = [(chance.uniform(0.45, 0.52), chance.uniform(-math.pi, math.pi)) for _ in range(runs)]
    moments = [chance.uniform(0.2, 1.4) for _ in range(runs)]
    return [
        (kind, *place, moment)
        for kind in IMPULSE
        for place, moment in zip(places, moments if kind == PUSHED else [0.0] * runs, strict=True)
    ]


def run(case: tuple[str, float, float, float]) -> Run:
    """Crouch, rise, and walk half a metre."""
    kind, height, direction, moment = case
    clock = Clock()
    humanoid = TrialHumanoid()
    push = IMPULSE[kind] * math.cos(direction), IMPULSE[kind] * math.sin(direction), 0.0
    problem, values = "", dict[str, float]()
    if kind == RATE:
        _rise_at_a_rate(humanoid, height, push)
    else:
        problem, values = _rise_in_phases(humanoid, height, push, moment)
    error = abs(float(humanoid.base_pose().position[2]) - STANCE)
    humanoid.walk_to(0.5, 0.0, 0.0)
    arrived = simulate(humanoid, 15.0, until=lambda: humanoid.arrived)
    if not problem and error > TOLERANCE:
        problem = f"rose to within {error:.3f} m"
    note = problem or ("" if arrived else "did not walk on")
    return run_of(case, humanoid, clock, note, {"error_m": error, **values})


def _rise_at_a_rate(humanoid: TrialHumanoid, height: float, push: Sequence[float]) -> None:
    """Get a push in the crouch, then rise at a rate as with cmd_vel."""
    humanoid.reset(height=height)
    simulate(humanoid, 0.5)
    humanoid.push(push)
    simulate(humanoid, 2.5)
    humanoid.move_body(0.1)
    simulate(humanoid, 2.5)


def _rise_in_phases(
    humanoid: TrialHumanoid, height: float, push: Sequence[float], moment: float
) -> tuple[str, dict[str, float]]:
    """Crouch, rise and be pushed; return the problem, the seconds in each phase, and the repeated shifts."""
    simulate(humanoid, 0.5)
    times = dict.fromkeys((phase.value for phase in WAY), 0.0)
    crouch = humanoid.crouch_to(height)
    _watch(humanoid, crouch, times)
    rise = humanoid.stand_up()
    _watch(humanoid, rise, times, until=humanoid.time + moment)
    humanoid.push(push)
    again = _watch(humanoid, rise, times)
    return crouch.problem or rise.problem, {**times, "again": again}


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


def summarize(runs: Sequence[Run]) -> list[Summary]:
    """Return one row for each kind."""
    titles = {
        RATE: f"crouch, {IMPULSE[RATE]:g} N·s, rise, walk on",
        PHASES: "crouch and stand up in phases, walk on",
        PUSHED: f"the same, {IMPULSE[PUSHED]:g} N·s while it stands up",
    }
    rows = []
    for kind, title in titles.items():
        group = [run for run in runs if run.case[0] == kind]
        measured = f"stance reached within {1000 * max(values_of(group, 'error_m')):.1f} mm"
        if kind != RATE:
            phases = (f"{phase.value} {mean(values_of(group, phase.value)):.2f} s" for phase in WAY)
            again = sum(run.values["again"] > 0 for run in group)
            measured += f"; mean {', '.join(phases)}; {again} shifted anew"
        rows.append(summary(title, group, measured, reference="all", met=all_succeeded(group)))
    return rows


TRIAL = Trial(cases, run, summarize)
