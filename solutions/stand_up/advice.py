"""Advice for failures: a goal that was rejected or aborted, and a robot that did not rise."""

from __future__ import annotations

from autograder.authoring import ABORTED, Failure, Goal, why_rclpy_aborted
from autograder.authoring.walking.life import run_of
from humanoid_interfaces.action import StandUp

from .truth import EARLY, GAIN, TIME_LIMIT, bodies, height_at

FROZEN = 10  # feedback messages; so many with the same value, while the robot rises, are no coincidence
ACCEPT = (
    "goal_callback must return GoalResponse.ACCEPT, also when the robot already stands (True is not "
    "GoalResponse.ACCEPT)."
)
FREE_AGAIN = (
    "An earlier goal has ended, so the robot is free again: record that in a finally block of execute."
)
STANDS_ALREADY = (
    "A rejection carries no reason, so the client cannot tell why: accept the goal, then abort it with "
    "ALREADY_STANDING."
)
UNKNOWN = (
    "In goal_callback, return GoalResponse.REJECT until you have received a message of odom and of each foot's "
    "wrench: set the variables that keep them to None in the constructor."
)
FALLEN = "The robot cannot get up after a fall: reject the goal if robot_state.mode is FALLEN, or abort it with FELL."
TIME_IS_UP = "12 s after acceptance, publish a zero Twist, and call abort() with a sentence in error_msg."


def require_not_given_up(goal: Goal) -> None:
    """Require that a goal that could succeed was not ABORTED; the advice depends on its error_code."""
    result = goal.result
    if result is None or result.status != ABORTED or why_rclpy_aborted(goal):
        return
    raise Failure(
        expected="status SUCCEEDED",
        observed=f"status ABORTED, error_code {result.result.error_code}: {result.result.error_msg[:200]!r}",
        help=_why_blind(goal) or _about_an_abort(goal),
        at=result.t,
    )


def about_the_height(goal: Goal, height: float) -> str:
    """Return advice on a goal that SUCCEEDED although the pelvis was too low, at `height` (m)."""
    if height < height_at(run_of(goal), goal.accepted_at) + GAIN:
        return "The robot never rose: publish a Twist with linear.z above 0 on cmd_vel at least every 0.5 s."
    return "Read odom's pose.pose.position.z, and continue the loop until it is 0.59 m."


def _why_blind(goal: Goal) -> str | None:
    """Return advice if percent_complete never changed although the robot rose, else None."""
    seen = [body.z for body in bodies(run_of(goal), goal.accepted_at, goal.run.end)]
    percents = {feedback.feedback.percent_complete for feedback in goal.feedback}
    if len(goal.feedback) < FROZEN or len(percents) > 1 or max(seen) < seen[0] + 0.05:
        return None
    return (
        f"percent_complete stayed {percents.pop():.0f} in all {len(goal.feedback)} feedback messages, though the robot "
        "rose. No callback for odom runs while execute blocks the only thread: use MultiThreadedExecutor, or make "
        "execute async and await in it."
    )


def _about_an_abort(goal: Goal) -> str:
    assert goal.result
    code, at = goal.result.result.error_code, goal.result.t
    if code == StandUp.Result.ALREADY_STANDING:
        return "robot_state.mode is STANDING also in a crouch: compare odom's height with 0.59 m instead."
    if code == StandUp.Result.FELL:
        return "The robot had not fallen, only been pushed: abort with FELL when robot_state.mode is FALLEN."
    if at - goal.accepted_at > TIME_LIMIT - EARLY:
        return (
            f"The goal reached its time limit with the pelvis at {height_at(run_of(goal), at):.2f} m. Publish cmd_vel "
            "in every round, as each message is valid for 0.5 s only. Then check the condition that ends the phase in "
            "which the goal stayed."
        )
    return "The robot could have risen: stay in the phase 'shifting' until the loads are even, up to the time limit."
