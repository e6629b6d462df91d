"""How the robot goes to a goal, and that it stands when none is active."""

from __future__ import annotations

import math

from geometry_msgs.msg import Twist

from autograder.authoring.diagnosis.missing import not_shown
from autograder.authoring.evidence.goal import SUCCEEDED, Goal
from autograder.authoring.evidence.robot_topic import DELIVERY
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure, expect
from autograder.authoring.walking import life
from autograder.authoring.walking.motion import require_limited_velocity, require_short_turn
from autograder.authoring.walking.planar import heading, target
from autograder.authoring.walking.truth import (
    STOP,
    STOP_TIME,
    require_accepted,
    require_standing,
)
from humanoid_interfaces.msg import RobotState
from ros_runtime.angles import wrap

MIN_DISTANCE = 0.25  # m; a shorter walk is too short to judge its speed
START_TIMEOUT = 3.0  # s from the acceptance until the robot must walk
STANDING_TIME = 1.2  # s after the result in which the robot must not move
ZERO = 1e-6  # m/s, rad/s
_SETTLE = (
    "Stop, settle, measure, then succeed: a humanoid takes up to a second to finish its step after a zero Twist. Wait "
    "until robot_state.mode has been STANDING for 0.5 s, and then read odom once more."
)


def obeys_max_velocity(goal: Goal) -> str | None:
    """From the start to the arrival the robot's mean speed is at most max_velocity."""
    limit = goal.request.max_velocity
    if (
        not life.accepted(goal)
        or not limit
        or not life.can_walk_at(goal, limit)
        or not life.began_at_rest(goal)
    ):
        return None
    if (
        not life.is_undisturbed(goal)
        or life.was_not_awaited(goal)
        or life.initial_distance(goal) < MIN_DISTANCE
    ):
        return None
    require_limited_velocity(goal)
    return "slow" if limit < 0.1 else "fast"


def walks_at_its_own_velocity(goal: Goal) -> str | None:
    """With max_velocity 0 it walks at a velocity of its own."""
    if (
        not life.accepted(goal)
        or goal.request.max_velocity != 0.0
        or life.initial_distance(goal) < MIN_DISTANCE
    ):
        return None
    assert goal.answer
    enough = goal.answer.t + START_TIMEOUT
    end = max(goal.answer.t, min(enough, life.ended_at(goal), goal.run.end))
    if any(robot.mode == RobotState.WALKING for robot in goal.run.robot_between(goal.answer.t, end)):
        return "max_velocity 0"
    if end < enough or life.fell_or_lost_power(goal) or life.granted(goal) or life.successors(goal):
        return None
    raise Failure(
        expected="the robot walking to its goal by then",
        observed=f"it does not walk at {end:.1f} s",
        help="max_velocity 0 asks for a velocity of your own: goal_handle.request.max_velocity or DEFAULT_VELOCITY. "
        "Publish it on cmd_vel as soon as the goal executes, and go on publishing it: the robot stops by itself 0.5 s "
        "after the last Twist.",
        at=end,
    )


def turns_the_short_way(goal: Goal) -> str | None:
    """It turns the shorter way round, also where the heading jumps from pi to -pi."""
    if not life.is_undisturbed(goal) or not life.began_at_rest(goal):
        return None
    start = goal.run.robot_at(goal.sent.t).yaw
    aim = heading(target(goal).orientation)
    if abs(wrap(aim - start)) < life.BIG_TURN and abs(aim) < math.pi - life.BIG_TURN:
        return None
    require_short_turn(goal)
    return "across pi" if abs(aim - start) > math.pi else "elsewhere"


def stands_at_success(goal: Goal) -> str | None:
    """When it SUCCEEDS the robot stands still, and stays so."""
    if goal.status != SUCCEEDED or life.successors(goal) or life.fell_or_lost_power(goal):
        return None
    assert goal.result
    since, end = goal.result.t, life.next_sent(goal, goal.result.t)
    if end - since < life.MIN_STANDING_TIME:
        return None
    require_accepted(goal)
    watched = goal.run.robot_between(since, min(since + STANDING_TIME, end))
    when = "when the goal SUCCEEDED, and"
    require_standing(watched, when, since, "the result", _SETTLE, goal.run.robot_ready.still)
    return "a goal where it stands" if life.initial_distance(goal) < life.AT_GOAL_DISTANCE else "a walk"


def ends_with_a_zero_twist(goal: Goal) -> str | None:
    """The last Twist before it SUCCEEDS is zero."""
    if goal.status != SUCCEEDED or life.successors(goal):
        return None
    assert goal.result
    run, end = life.run_of(goal), life.next_sent(goal, goal.result.t)
    velocities = [each for each in run.received("cmd_vel") if each.t < end]
    if (
        not any(goal.sent.t <= each.t for each in velocities)
        and life.initial_distance(goal) < life.AT_GOAL_DISTANCE
    ):
        return "nothing published where it stands"
    require_accepted(goal)
    if not velocities:
        raise not_shown(run, "the last Twist before a success is zero")
    before = [each for each in velocities if goal.sent.t <= each.t <= goal.result.t]
    expect(
        bool(before) and _is_zero(before[-1].message),
        expected="a zero Twist as the last on cmd_vel before the goal SUCCEEDED",
        observed=_shown(before[-1].message) if before else "none",
        help="The robot walks on for 0.5 s after the last other Twist. Publish Twist(), all zeros, before you wait "
        "for the robot to stand, and no other after it.",
        at=goal.result.t,
    )
    return "walked" if life.initial_distance(goal) >= life.AT_GOAL_DISTANCE else "stood there"


def does_not_steer_without_a_goal(run: Transcript) -> str | None:
    """Without an active goal it publishes no velocity but zero."""
    moving = [each for each in run.received("cmd_vel") if not _is_zero(each.message)]
    for each in moving:
        expect(
            _has_goal(run, each.t),
            expected="nothing but zeros on cmd_vel while no goal is active",
            observed=_shown(each.message),
            help="Your node publishes without a goal: a timer or a thread does not stop with the goal, or serves a "
            "goal that was rejected.",
            at=each.t,
        )
    return "all the time" if run.goals else None


def stands_without_a_goal(run: Transcript) -> str | None:
    """Without an active goal the robot stands where it is."""
    if not run.ground_truth or not run.goals:
        return None
    limit = run.robot_ready.still
    for robot in run.ground_truth:
        if robot.mode in (RobotState.FALLEN, RobotState.OFF):
            break
        if robot.t < run.goals[0].sent.t - DELIVERY or _has_goal(run, robot.t, STOP_TIME):
            continue
        expect(
            robot.speed < limit,
            expected=f"the robot slower than {limit:.2f} m/s while no goal is active",
            observed=f"{robot.speed:.2f} m/s",
            help=STOP,
            at=robot.t,
        )
    return "all the time"


def _is_zero(velocity: Twist) -> bool:
    """Return whether a velocity lets the robot stand."""
    linear, angular = velocity.linear, velocity.angular
    return all(abs(value) <= ZERO for value in (linear.x, linear.y, angular.z))


def _shown(velocity: Twist) -> str:
    """Return a velocity in words."""
    linear = velocity.linear
    return f"x {linear.x:.2f} m/s, y {linear.y:.2f} m/s, turn {velocity.angular.z:.2f} rad/s"


def _has_goal(run: Transcript, t: float, afterwards: float = DELIVERY / 2) -> bool:
    """Return whether a goal was active at a time (s), or had been so shortly before."""
    return any(
        goal.sent.t <= t <= (life.ended_at(goal) + afterwards if life.accepted(goal) else goal.sent.t)
        for goal in run.goals
    )
