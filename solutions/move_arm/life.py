"""What happened during a goal of move_arm, and how the goal has to end because of what the arm did."""

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
UNCERTAIN = 0.1  # rad below PATH_TOLERANCE, where a server may or may not abort
MEASUREMENT_SLACK = 0.02  # rad, as a server's last joint_states may differ from the simulator's positions
# s after the last point is due; a joint released until then surely arrives
SURE_ARRIVAL_TIME = 0.6 * ARRIVAL_TIME
ROUND = 0.05  # s, the period of joint_states


class Fate(Enum):
    """How a goal ends, unless something else ends it."""

    ARRIVES = "arrives"
    STRAYS = "strays from its path"
    MISSES = "misses its end"


@dataclass(frozen=True)
class Hold:
    """Joints of a goal that the scenario blocked from `since` to `until` (s; infinity: to the end of the run)."""

    joints: tuple[str, ...]
    since: float
    until: float


def is_carried_out(goal: Goal) -> bool:
    """Return whether the goal was accepted, and is valid."""
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
    """Return when (s) the next goal for the same arm was sent after a time (s), or the end of the run."""
    sent = [other.sent.t for other in goals.others(goal) if other.request.arm == goal.request.arm]
    return min((t for t in sent if t > after), default=goal.run.end)


def silent_since(goal: Goal) -> float | None:
    """Return when (s) joint_states stopped, if they were off when the goal ended, else None."""
    switches = [each for each in goal.run.commands("joint_sensors") if each.t < goals.ended_at(goal)]
    return switches[-1].t if switches and not switches[-1].command["connected"] else None


def ends_by_itself(goal: Goal) -> bool:
    """Return whether only the arm's motion ends the goal: no cancel, newer goal, loss of joint_states or Ctrl-C."""
    if not is_carried_out(goal) or silent_since(goal) is not None:
        return False
    return not (goals.granted(goal) or goals.successors(goal) or goals.interrupted(goal))


def hold_of(goal: Goal) -> Hold | None:
    """Return which joints of an accepted goal the scenario blocked until 1 s after its last point was due, or None."""
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
    """Return how an accepted goal has to end because of what the arm did; None if that is uncertain."""
    hold = hold_of(goal)
    if hold is None:
        return Fate.ARRIVES
    plan, tolerance = plan_of(goal), tolerance_of(goal)
    was_held_to_its_end = goals.ended_at(goal) <= hold.until
    perhaps, surely = first_off(goal, hold, PATH_TOLERANCE - UNCERTAIN), first_off(goal, hold, PATH_TOLERANCE)
    if was_held_to_its_end or perhaps < hold.until:
        if surely < math.inf:
            return Fate.STRAYS if was_held_to_its_end or surely < hold.until else None
        if perhaps < math.inf:
            return None
    short = _off(goal, hold, plan.end, plan.final())
    if short <= tolerance - MEASUREMENT_SLACK or hold.until <= plan.end + SURE_ARRIVAL_TIME:
        return Fate.ARRIVES
    return Fate.MISSES if was_held_to_its_end and short > tolerance + MEASUREMENT_SLACK else None


def first_off(goal: Goal, hold: Hold, off: float = PATH_TOLERANCE) -> float:
    """Return when (s) a blocked joint is first off its trajectory by `off` (rad), or infinity.

    After its release, the joint counts as if it had stayed where it was released.
    """
    plan = plan_of(goal)
    for number in range(math.ceil((plan.end - hold.since) / ROUND) + 1):
        t = hold.since + number * ROUND
        if _off(goal, hold, t, plan.at(t)) >= off:
            return t
    return math.inf


def _off(goal: Goal, hold: Hold, t: float, wanted: Mapping[str, float]) -> float:
    """Return the largest distance (rad) of a blocked joint from its wanted position, if all are blocked until `t` s."""
    held_until = min(t, hold.until, goal.run.end)
    return worst_at(goal, held_until, {joint: wanted[joint] for joint in hold.joints})[1]


def situation(goal: Goal) -> str:
    """Return, for the table of clauses, what happened during a goal that ended by itself."""
    hold = hold_of(goal)
    how = "unhindered" if hold is None else "blocked"
    if hold and hold.until < math.inf and hold.until < goals.ended_at(goal):
        how = "released in time"
    return f"{how}, together with the other arm" if neighbours(goal) else how
