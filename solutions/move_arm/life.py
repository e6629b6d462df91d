"""The life of a goal that moves an arm: what else happened in it, and how it has to end by what the arm did."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from autograder.authoring import Goal, ev
from autograder.authoring.walking import life as goals

from .endings import ARRIVAL_TIME, tolerance_of
from .objections import is_sound
from .truth import plan_of, worst_at

PATH_TOLERANCE = 0.5  # rad
NEARLY = 0.1  # rad less, from which on nobody can tell whether a joint is off its trajectory
MEASURED = 0.02  # rad more, for what joint_states were when the server looked
IN_TIME = 0.6 * ARRIVAL_TIME  # s after the last point in which a joint that is let go surely arrives
ROUND = 0.05  # s, the period of joint_states


class Fate(Enum):
    """How a goal ends, unless something else ends it."""

    ARRIVES = "arrives"
    STRAYS = "strays from its path"
    MISSES = "misses its end"


@dataclass(frozen=True)
class Hold:
    """Some joints of a goal that the scenario held, from `since` until `until` (s; infinity: to the end of the run)."""

    joints: tuple[str, ...]
    since: float
    until: float


def is_carried_out(goal: Goal) -> bool:
    """Return whether it was accepted, and nothing speaks against it."""
    return goals.accepted(goal) and is_sound(goal)


def neighbours(goal: Goal) -> list[Goal]:
    """Return the accepted goals of the other arm that were active at the same time."""
    return [
        other
        for other in goals.others(goal)
        if goals.accepted(other)
        and other.request.arm != goal.request.arm
        and max(other.sent.t, goal.sent.t) < min(goals.ended_at(other), goals.ended_at(goal))
    ]


def next_for_the_arm(goal: Goal, after: float) -> float:
    """Return when (s) the next goal for its arm was sent after a moment, or the run's end."""
    sent = [other.sent.t for other in goals.others(goal) if other.request.arm == goal.request.arm]
    return min((t for t in sent if t > after), default=goal.run.end)


def silent_since(goal: Goal) -> float | None:
    """Return when (s) joint_states stopped, if they were silent while the goal was active."""
    switches = [each for each in goal.run.commands("joint_sensors") if each.t < goals.ended_at(goal)]
    return switches[-1].t if switches and not switches[-1].command["connected"] else None


def ends_by_itself(goal: Goal) -> bool:
    """Return whether nothing but the arm ends it: no cancel that was granted, no newer goal, silence or Ctrl-C."""
    if not is_carried_out(goal) or silent_since(goal) is not None:
        return False
    return not (goals.granted(goal) or goals.successors(goal) or goals.interrupted(goal))


def hold_of(goal: Goal) -> Hold | None:
    """Return what the scenario held of an accepted goal's joints until its last point's second was over."""
    over = plan_of(goal).end + ARRIVAL_TIME
    joints: list[str] = []
    since, until = math.inf, math.inf
    for each in goal.run.all(ev.RobotCommanded):
        joint = each.command.get("joint", "")
        if joint not in goal.request.trajectory.joint_names or not goal.sent.t <= each.t:
            continue
        if each.command["do"] == "hold_joint" and each.t < over:
            joints.append(joint)
            since = min(since, each.t)
        elif each.command["do"] == "release_joint" and joint in joints:
            until = min(until, each.t)
    return Hold(tuple(joints), since, until) if joints else None


def fate_of(goal: Goal) -> Fate | None:
    """Return how an accepted goal ends by what the arm did; None: nobody can tell."""
    hold = hold_of(goal)
    if hold is None:
        return Fate.ARRIVES
    plan, tolerance = plan_of(goal), tolerance_of(goal)
    was_held_to_its_end = goals.ended_at(goal) <= hold.until
    perhaps, surely = first_off(goal, hold, PATH_TOLERANCE - NEARLY), first_off(goal, hold, PATH_TOLERANCE)
    if was_held_to_its_end or perhaps < hold.until:
        if surely < math.inf:
            return Fate.STRAYS if was_held_to_its_end or surely < hold.until else None
        if perhaps < math.inf:
            return None
    short = _off(goal, hold, plan.end, plan.final())
    if short <= tolerance - MEASURED or hold.until <= plan.end + IN_TIME:
        return Fate.ARRIVES
    return Fate.MISSES if was_held_to_its_end and short > tolerance + MEASURED else None


def first_off(goal: Goal, hold: Hold, off: float = PATH_TOLERANCE) -> float:
    """Return when (s) a held joint is off its trajectory by `off` (rad); where it was let go early it is thought on.

    Infinity if it never is.
    """
    plan = plan_of(goal)
    for number in range(math.ceil((plan.end - hold.since) / ROUND) + 1):
        t = hold.since + number * ROUND
        if _off(goal, hold, t, plan.at(t)) >= off:
            return t
    return math.inf


def _off(goal: Goal, hold: Hold, t: float, wanted: Mapping[str, float]) -> float:
    """Return how far (rad) the worst held joint is from where it is wanted at `t` s, if they are held until then."""
    held_until = min(t, hold.until, goal.run.end)
    return worst_at(goal, held_until, {joint: wanted[joint] for joint in hold.joints})[1]


def situation(goal: Goal) -> str:
    """Return, for the table of clauses, what happened to a goal that ended by itself."""
    hold = hold_of(goal)
    how = "unhindered" if hold is None else "held"
    if hold and hold.until < math.inf and hold.until < goals.ended_at(goal):
        how = "let go in time"
    return f"{how}, beside the other arm" if neighbours(goal) else how
