"""The time that a goal takes: what is told of it, the time limit, and how fast a goal is over where the robot is."""

from __future__ import annotations

from autograder.authoring import ABORTED, SUCCEEDED, Goal, expect
from autograder.authoring.walking import life
from autograder.authoring.walking.obligations.tells import seconds
from autograder.authoring.walking.planar import error
from autograder.authoring.walking.reports import require_error_code
from autograder.authoring.walking.truth import require_arrival, require_stopped

from .legs import Leg, at_moment, operated, told, under_way

TIME_SLACK = 1.0  # s that a reported time may be off: feedback's period and delivery
FACTOR = 2.0
TIMEOUT_EARLY, TIMEOUT_LATE = (
    1.5,
    4.0,
)  # s a TIMEOUT may come too early, and too late: the robot has to stand first
HERE = 0.05  # m or rad that the present pose may be off
HERE_TIME = 4.0  # s
STAYED = 0.10  # m the pelvis may move while the robot only stands


def tells_its_time(goal: Goal) -> str | None:
    """navigation_time is the time since this goal was accepted."""
    if not life.accepted(goal) or life.interrupted(goal):
        return None
    start, reports = goal.accepted_at, told(goal)
    if not reports or reports[-1].t - start < 2 * TIME_SLACK:
        return None
    for feedback in reports:
        claimed, true = seconds(feedback.feedback.navigation_time), feedback.t - start
        expect(
            abs(claimed - true) <= TIME_SLACK,
            expected=f"navigation_time near {true:.1f} s, since the goal was accepted",
            observed=f"{claimed:.1f} s",
            help="Remember when the goal is accepted, and subtract that: neither the node's start nor the phase's."
            if claimed
            else "Fill feedback.navigation_time from the time since the goal was accepted.",
            at=feedback.t,
        )
    return life.phase(goal)


def estimates_the_time(goal: Goal) -> str | None:
    """estimated_time_remaining is positive under way, and right within a factor of 2 half way."""
    leg = Leg.of(goal)
    if leg is None:
        return None
    for feedback in under_way(goal):
        estimate = seconds(feedback.feedback.estimated_time_remaining)
        expect(
            estimate > 0,
            expected="estimated_time_remaining above 0 while the robot is under way",
            observed=f"{estimate:.2f} s",
            help="Fill it in every feedback, with rclpy.duration.Duration(seconds=…).to_msg(): int seconds alone are 0 "
            "for the last second, and a speed of 0 divides by zero.",
            at=feedback.t,
        )
    estimate, left = seconds(at_moment(goal, leg.half).feedback.estimated_time_remaining), leg.end - leg.half
    expect(
        left / FACTOR <= estimate <= left * FACTOR,
        expected=f"estimated_time_remaining from {left / FACTOR:.1f} to {left * FACTOR:.1f} s half way, as it took "
        f"{left:.1f} s more",
        observed=f"{estimate:.1f} s",
        help="Divide what is left by the speed that the robot really has while it walks, and add the time of the last "
        "turn and of standing still.",
        at=leg.half,
    )
    return life.phase(goal)


def gives_up_in_time(goal: Goal) -> str | None:
    """A goal that is not reached 30 s and 15 s per metre after its acceptance ends ABORTED with TIMEOUT, not before."""
    if not life.accepted(goal) or life.interrupted(goal):
        return None
    start, result = goal.accepted_at, goal.result
    limit = 30.0 + 15.0 * error(goal.run.robot_at(start), goal)[0]
    given_up = goal.run.given_up("result", goal.name)
    lasted = (result.t if result else given_up.t if given_up else goal.run.end) - start
    if not _timed_out(goal) and lasted < limit + (
        TIMEOUT_LATE if goal.status == SUCCEEDED else -TIMEOUT_EARLY
    ):
        return None
    end = goal.require_result(
        ABORTED,
        help="Compare the time since acceptance with the limit in every round, also while the robot does not get on.",
    )
    require_error_code(goal, "TIMEOUT", because="the time is over")
    expect(
        limit - TIMEOUT_EARLY <= lasted <= limit + TIMEOUT_LATE,
        expected=f"TIMEOUT {limit:.0f} s after acceptance, 30 s and 15 s per metre that was to go then",
        observed=f"it came after {lasted:.1f} s",
        help="Compute the limit once, from the distance at acceptance, and count from acceptance.",
        at=end.t,
    )
    return "held" if operated(goal, "hold") else "under way"


def stands_after_the_limit(goal: Goal) -> str | None:
    """After TIMEOUT the robot stands still, also when it is let go."""
    if not _timed_out(goal) or not operated(goal, "hold"):
        return None
    require_stopped(goal.run, goal.run.told("take_over", velocity=None).t, event="being let go")
    return "let go"


def succeeds_where_it_stands(goal: Goal) -> str | None:
    """A goal equal to the present pose SUCCEEDS within 4 s, and the robot does not walk."""
    distance, turn = error(goal.run.robot_at(goal.sent.t), goal)
    is_there = distance <= HERE and turn <= HERE and life.began_at_rest(goal)
    if not is_there or not life.is_undisturbed(goal) or life.left_alone(goal):
        return None
    require_arrival(goal)
    end = goal.require_result(SUCCEEDED)
    took = end.t - goal.accepted_at
    expect(
        took <= HERE_TIME,
        expected=f"success within {HERE_TIME:.0f} s: the robot is there already",
        observed=f"it came after {took:.1f} s",
        help="Look whether the robot is there before you look where to turn: at distance 0 the bearing means nothing.",
        at=end.t,
    )
    steps = goal.run.robot_at(end.t).steps - goal.run.robot_at(goal.sent.t).steps
    expect(
        steps == 0,
        expected="success without a step: the robot is there already",
        observed=f"{steps} steps",
        help="Publish no velocity but zero when distance and turn are within the tolerance from the beginning.",
        at=end.t,
    )
    distance = float(end.result.distance_traveled)
    expect(
        0.0 <= distance <= STAYED,
        expected="distance_traveled 0 m: the robot did not walk",
        observed=f"{distance:.2f} m",
        help="Begin the path of each goal at 0, where the robot is when it is accepted.",
        at=end.t,
    )
    return life.phase(goal)


def _timed_out(goal: Goal) -> bool:
    result = goal.result
    return bool(result and result.status == ABORTED and result.result.error_code == result.result.TIMEOUT)
