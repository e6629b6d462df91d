"""What happened during a goal of pick_and_place: what the scenario did to cup, arm and robot."""

from __future__ import annotations

import math

from autograder.authoring import Goal
from autograder.authoring.walking import life as goals

from .objections import is_sound
from .truth import carried, cup_at, place_of, taken_from

CUP = "cup"  # the object on the table
SHOULDER = (0.0, -0.17)  # m in odom
SURE_REACH, NO_REACH = 0.45, 0.65  # m from the shoulder: certainly within reach, certainly beyond it
MAX_AGE = 0.3  # s, of the last report on the cup
HOLDING_FORCE = 1.0  # N


def commanded(goal: Goal, do: str) -> float | None:
    """Return the time (s) of the scenario's first command `do` while the goal was active, or None."""
    end = min(goals.ended_at(goal), goal.run.end)
    return next((each.t for each in goal.run.commands(do) if goal.sent.t < each.t < end), None)


def robbed_at(goal: Goal) -> float | None:
    """Return when (s) the cup was taken away while the goal was active."""
    return commanded(goal, "move_object")


def is_for_the_cup(goal: Goal) -> bool:
    """Return whether the goal was accepted, is valid, and names the cup as its object."""
    return goals.accepted(goal) and is_sound(goal) and bool(goal.request.object_id == CUP)


def is_far(goal: Goal) -> bool | None:
    """Return whether the cup or its place is out of reach; None if that is uncertain."""
    away = [math.dist(place[:2], SHOULDER) for place in (taken_from(goal), place_of(goal))]
    return True if max(away) > NO_REACH else None if max(away) > SURE_REACH else False


def rivals(goal: Goal) -> list[Goal]:
    """Return the goals that were active when this one was sent, or were sent while it was active, accepted or not."""
    return [
        other
        for other in goals.others(goal)
        if (goals.accepted(other) and other.sent.t < goal.sent.t < goals.ended_at(other))
        or (goals.accepted(goal) and goal.sent.t < other.sent.t < goals.ended_at(goal))
    ]


def canceled_at(goal: Goal) -> float | None:
    """Return when (s) the first cancel request was sent while the goal was active."""
    times = [cancel.sent.t for cancel in goals.requests_to_cancel(goal) if goals.accepted(goal)]
    return min((t for t in times if goal.accepted_at <= t < goals.ended_at(goal)), default=None)


def is_possible(goal: Goal) -> bool:
    """Return whether the goal names the cup, within reach, and the scenario did nothing to cup, arm or robot."""
    if not is_for_the_cup(goal) or is_far(goal) is not False:
        return False
    return not any(commanded(goal, do) for do in ("move_object", "hold_joint", "push"))


def ends_by_itself(goal: Goal) -> bool:
    """Return whether the goal was accepted, is valid, and no cancel, other goal or Ctrl-C ended it."""
    cut = goals.granted(goal) or goals.successors(goal) or goals.interrupted(goal)
    return goals.accepted(goal) and is_sound(goal) and not cut and canceled_at(goal) is None


def watched_until(goal: Goal) -> float:
    """Return when (s) the final state of cup and hand is changed: by the next goal, or when the cup is moved."""
    taken = [each.t for each in goal.run.commands("move_object") if each.t > goals.ended_at(goal)]
    return min([goals.next_sent(goal, max(goal.sent.t, min(goals.ended_at(goal), goal.run.end))), *taken])


def holds_at(goal: Goal, t: float) -> bool:
    """Return whether the hand held the cup off the table at a time (s)."""
    held = carried(goal, t)
    return bool(held) and held[-1].t >= t - MAX_AGE and held[-1].force >= HOLDING_FORCE


def nearer_place(goal: Goal, t: float, alike: float) -> str | None:
    """Return which is nearer to the cup, 'where it stood' or 'place_pose'.

    None if the two distances differ by less than `alike` m.
    """
    cup = cup_at(goal.run, t).position[:2]
    back, there = math.dist(cup, taken_from(goal)[:2]), math.dist(cup, place_of(goal)[:2])
    if abs(back - there) < alike:
        return None
    return "where it stood" if back < there else "place_pose"
