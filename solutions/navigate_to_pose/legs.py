"""The robot's way to a goal of navigate_to_pose, with or without a detour commanded by an operator."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from autograder.authoring import STEPS, SUCCEEDED, Goal, Transcript, ev, goals, not_shown, require_feedback
from autograder.authoring.walking import life
from autograder.authoring.walking.planar import error, target
from ros_runtime.angles import wrap

UNDER_WAY_DISTANCE = 0.3  # m; a robot that is farther from its goal is under way
MIN_LEG = 1.0  # m; on a shorter leg the robot has no time in which it only walks
DETOUR_ANGLE = 0.6  # rad between heading and goal, more than the task's 0.5


@dataclass(frozen=True)
class Leg:
    """A long undisturbed way to a goal, with the time at which half of its distance was left."""

    goal: Goal
    start: float  # s
    half: float  # s
    end: float  # s


def legs(run: Transcript) -> Iterator[Leg]:
    """Occasions: the long undisturbed ways; their goals must have succeeded."""
    for goal in goals(run):
        if not life.is_undisturbed(goal) or life.was_not_awaited(goal) or operated(goal):
            continue
        if life.initial_distance(goal) < MIN_LEG:
            continue
        yield _leg_to(goal)


def _leg_to(goal: Goal) -> Leg:
    end = goal.require_result(SUCCEEDED).t
    start = goal.accepted_at
    whole, _turn = error(goal.run.robot_at(start), goal)
    for robot in goal.run.robot_between(start, end):
        if error(robot, goal)[0] <= whole / 2:
            return Leg(goal, start, robot.t, end)
    raise not_shown(goal.run, f"the robot walks half of the way to “{goal.name}”")


def operated(goal: Goal, *how: str) -> bool:
    """Return whether the scenario controls the robot during the goal: by the verbs `how`, by default any of them."""
    newest = None
    for verb, *arguments in life.run_of(goal).params[STEPS]:
        if verb in (how or ("lead_astray", "hold")) and newest == goal.name:
            return True
        newest = arguments[0] if verb in ("go", "go_on") else newest
    return False


def led_astray(goal: Goal) -> tuple[float, float] | None:
    """Return when (s) an operator's detour began and ended; the robot must then be turned away from its goal."""
    if not life.accepted(goal) or life.interrupted(goal) or not operated(goal, "lead_astray"):
        return None
    run = goal.run
    taken, given = (
        run.last_command("take_over", velocity=[-0.2, 0.0, 0.0]),
        run.last_command("take_over", velocity=None),
    )
    off = off_the_way(run.robot_at(given.t), goal)
    if off < DETOUR_ANGLE:
        raise not_shown(
            run, f"the robot returns from a detour: it faced {off:.1f} rad off its way at the end"
        )
    return taken.t, given.t


def off_the_way(robot: ev.RobotTruth, goal: Goal) -> float:
    """Return the angle (rad, 0 to pi) between the robot's heading and the bearing of its goal."""
    place = target(goal).position
    return abs(wrap(robot.yaw - math.atan2(place.y - robot.y, place.x - robot.x)))


def feedback_of(goal: Goal) -> Sequence[ev.FeedbackReceived]:
    """Return the feedback until the result; another check is about later feedback."""
    return [feedback for feedback in goal.feedback if goal.result is None or feedback.t <= goal.result.t]


def under_way(goal: Goal) -> Sequence[ev.FeedbackReceived]:
    """Return the feedback that came while more than 0.3 m were left; there must be some."""
    far = [
        each for each in feedback_of(goal) if error(goal.run.robot_at(each.t), goal)[0] > UNDER_WAY_DISTANCE
    ]
    if not far:
        raise not_shown(goal.run, f"feedback comes while the robot is on its way to “{goal.name}”")
    return far


def feedback_half_way(leg: Leg) -> ev.FeedbackReceived:
    """Return the last feedback before half of the distance was left, or the first."""
    require_feedback(leg.goal)
    feedback = leg.goal.feedback
    return next((each for each in reversed(feedback) if each.t <= leg.half), feedback[0])
