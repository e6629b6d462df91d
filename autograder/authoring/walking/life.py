"""When a goal that walks the robot was certainly active, and what else happened meanwhile."""

from __future__ import annotations

import math
from typing import cast

from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.goal import Cancel, Goal
from autograder.authoring.evidence.robot_topic import DELIVERY
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.walking.planar import error, tolerance
from humanoid_interfaces.msg import RobotState
from ros_runtime.message_constants import GoalStatus, name_of

TERMINAL = (GoalStatus.SUCCEEDED, GoalStatus.CANCELED, GoalStatus.ABORTED)
AT_GOAL_DISTANCE = 0.1  # m; a robot that is no farther from its goal need not walk
BIG_TURN = 0.3  # rad
MIN_STANDING_TIME = 0.5  # s; a robot that was observed for less may still be moving
# A robot is "just before arrival" if its distance and its turn to the goal are within both limits:
NEAR_DISTANCE = 0.15  # m, in addition to the tolerance
NEAR_TURN = 0.3  # rad


def run_of(goal: Goal) -> Transcript:
    """Return the whole run that a goal belongs to."""
    return cast(Transcript, goal.run)


def can_walk_at(goal: Goal, velocity: float) -> bool:
    """Return whether the robot of this run can walk at a velocity (m/s)."""
    return velocity <= run_of(goal).robot_ready.fastest


def accepted(goal: Goal) -> bool:
    """Return whether the server accepted it; raise if later events show that the record lacks its answer."""
    has_begun = goal.result or goal.feedback or goal.statuses
    if goal.answer is None and has_begun and goal.run.given_up("goal", goal.name) is None:
        raise unseen(goal.run, f"the record lacks the answer to the goal “{goal.name}”")
    return goal.answer is not None and goal.answer.accepted


def ended_at(goal: Goal) -> float:
    """Return when (s) its end was first known, by its status or its result; infinity if it never was."""
    times = [seen.t for seen in goal.statuses if seen.status in TERMINAL]
    if goal.result:
        times.append(goal.result.t)
    return min(times, default=math.inf)


def others(goal: Goal) -> list[Goal]:
    """Return the other goals of the run."""
    return [other for other in run_of(goal).goals if other.name != goal.name]


def overlaps(goal: Goal, asked: Goal) -> bool | None:
    """Return whether a goal was active from the time `asked` was sent until it was answered; None: that is unknown.

    A goal that was ABORTED in that time counts as active: it gave way.
    """
    answered = asked.answer.t if asked.answer else run_of(goal).end
    if not accepted(goal) or goal.sent.t > answered or ended_at(goal) + DELIVERY / 2 < asked.sent.t:
        return False
    assert goal.answer
    if goal.answer.t >= asked.sent.t:
        return None
    gave_way = goal.status == GoalStatus.ABORTED and ended_at(goal) > asked.sent.t
    return True if gave_way or ended_at(goal) > answered + DELIVERY else None


def successors(goal: Goal) -> list[Goal]:
    """Return the goals that were sent and accepted while this one was active, in order."""
    return [other for other in rivals(goal) if goal.accepted_at < other.sent.t < ended_at(goal)]


def together_with(goal: Goal) -> list[Goal]:
    """Return the accepted goals whose time from request to answer overlaps with that of this goal."""
    return [
        other
        for other in rivals(goal)
        if other.sent.t <= goal.accepted_at and goal.sent.t <= other.accepted_at
    ]


def rivals(goal: Goal) -> list[Goal]:
    """Return the other accepted goals, of the same arm where goals name one; none, if this one was not accepted."""
    arm = getattr(goal.request, "arm", None)
    same = [other for other in others(goal) if getattr(other.request, "arm", None) == arm]
    return [other for other in same if accepted(other)] if accepted(goal) else []


def requests_to_cancel(goal: Goal) -> list[Cancel]:
    """Return the requests to cancel it, and those to cancel all goals that were sent before the next goal."""
    end = next_sent(goal, goal.sent.t)
    return [
        cancel
        for cancel in run_of(goal).cancels
        if cancel.sent.goal == goal.name or (not cancel.sent.goal and goal.sent.t <= cancel.sent.t < end)
    ]


def cancels_on_the_way(goal: Goal) -> list[Cancel]:
    """Return the requests to cancel it that came while it was active."""
    if goal.answer is None:
        return []
    return [cancel for cancel in requests_to_cancel(goal) if goal.answer.t <= cancel.sent.t < ended_at(goal)]


def granted(goal: Goal) -> list[Cancel]:
    """Return the requests to cancel it that the server accepted."""
    return [each for each in run_of(goal).cancels if each.answer and goal.name in each.answer.canceling]


def near_arrival(goal: Goal, t: float) -> bool:
    """Return whether the robot was so near its goal at a time (s) that it may arrive at any moment."""
    distance, turn = error(goal.run.robot_at(t), goal)
    return distance <= tolerance(goal) + NEAR_DISTANCE and turn <= NEAR_TURN


def fell_or_lost_power(goal: Goal) -> ev.RobotTruth | None:
    """Return the first sample, while the goal was active, in which the robot has fallen or has no power, or None."""
    if not accepted(goal) or not run_of(goal).ground_truth:
        return None
    start = goal.accepted_at
    robots = goal.run.robot_between(start, max(start, min(ended_at(goal) + DELIVERY, goal.run.end)))
    return next((robot for robot in robots if robot.mode in (RobotState.OFF, RobotState.FALLEN)), None)


def interrupted(goal: Goal) -> bool:
    """Return whether Ctrl-C was pressed while the goal was active."""
    signalled = goal.run.first(ev.NodeSignalled)
    return signalled is not None and goal.sent.t < signalled.t < ended_at(goal)


def is_undisturbed(goal: Goal) -> bool:
    """Return whether nothing happened during its walk: no accepted cancel, no other goal, fall or Ctrl-C."""
    return accepted(goal) and not was_disturbed(goal) and not together_with(goal)


def was_disturbed(goal: Goal) -> bool:
    """Return whether an accepted cancel, a later goal, a fall or Ctrl-C came while it was active."""
    return bool(granted(goal) or successors(goal) or fell_or_lost_power(goal) or interrupted(goal))


def next_sent(goal: Goal, after: float) -> float:
    """Return when (s) the next goal after a moment was sent, or the run's end."""
    return min([other.sent.t for other in run_of(goal).goals if other.sent.t > after], default=goal.run.end)


def began_at_rest(goal: Goal) -> bool:
    """Return whether the robot stood when the goal was sent."""
    return goal.run.robot_at(goal.sent.t).mode == RobotState.STANDING


def phase(goal: Goal) -> str:
    """Return, for the table of clauses, what the goal came after: 'at first', 'after SUCCEEDED' and so on."""
    before = [other for other in others(goal) if other.sent.t < goal.sent.t]
    if not before:
        return "at first"
    last = before[-1]
    if not accepted(last):
        return "after a rejected one"
    if ended_at(last) > goal.sent.t:
        return "while another is active"
    return f"after {name_of(GoalStatus, last.status or GoalStatus.UNKNOWN)}"


def was_not_awaited(goal: Goal) -> bool:
    """Return whether the scenario ended before the goal did, and had not waited for its end."""
    return goal.result is None and goal.run.given_up("result", goal.name) is None


def initial_distance(goal: Goal) -> float:
    """Return how far (m) the robot was from the goal when the goal was sent."""
    return error(goal.run.robot_at(goal.sent.t), goal)[0]
