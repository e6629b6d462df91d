"""Whether a walk that SUCCEEDED ended in a stop: commanded, and over when the result came."""

from __future__ import annotations

import math

from geometry_msgs.msg import Twist

from autograder.authoring.diagnosis.missing import not_shown
from autograder.authoring.evidence.goal import SUCCEEDED, Goal
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.authoring.walking.truth import require_accepted, require_standing

STANDING = 1.2  # s after the result in which it must not move
ZERO = 1e-6  # m/s, rad/s
_SETTLE = (
    "Stop, settle, measure, then succeed: a humanoid takes up to a second to finish its step after a zero Twist. Wait "
    "until robot_state.mode has been STANDING for 0.5 s, and look at odom once more."
)


def require_final_zero(run: Transcript, goal: Goal, until: float = math.inf) -> None:
    """Require that the last Twist before a goal SUCCEEDED is zero; another goal was sent `until` s."""
    result = require_accepted(goal).require_result(SUCCEEDED)
    velocities = [each for each in run.received("cmd_vel") if each.t < until]
    if not velocities:
        raise not_shown(run, "the last Twist before a success is zero")
    before = [each for each in velocities if goal.sent.t <= each.t <= result.t]
    if not before or not is_zero(before[-1].message):
        raise Failure(
            expected="a zero Twist as the last on cmd_vel before the goal SUCCEEDED",
            observed=shown(before[-1].message) if before else "none",
            help="The robot would walk on for 0.5 s after the last one. Publish Twist(), all zeros, before you wait "
            "for the robot to stand, and no other after it.",
            at=result.t,
        )


def require_standing_at_success(goal: Goal, until: float = math.inf) -> None:
    """Require that the robot stood still when the goal SUCCEEDED, and stayed so, at most until another came (s)."""
    result = require_accepted(goal).require_result(SUCCEEDED)
    watched = goal.run.robot_between(result.t, min(result.t + STANDING, until))
    require_standing(watched, "when the goal SUCCEEDED, and", result.t, "the result", _SETTLE)


def is_zero(velocity: Twist) -> bool:
    """Return whether a velocity lets the robot stand."""
    linear, angular = velocity.linear, velocity.angular
    return all(abs(value) <= ZERO for value in (linear.x, linear.y, angular.z))


def shown(velocity: Twist) -> str:
    """Return a velocity in words."""
    linear = velocity.linear
    return f"x {linear.x:.2f} m/s, y {linear.y:.2f} m/s, turn {velocity.angular.z:.2f} rad/s"
