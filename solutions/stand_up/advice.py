"""What to do about a goal that was rejected or given up, and about a robot that did not rise."""

from __future__ import annotations

from autograder.authoring import ABORTED, Failure, Goal, why_rclpy_aborted
from autograder.authoring.walking.life import run_of
from humanoid_interfaces.action import StandUp

from .truth import EARLY, GAIN, TIME_LIMIT, bodies, height_at

FROZEN = 10  # feedback messages; so many alike are no coincidence while the robot rises
ACCEPT = (
    "goal_callback must return GoalResponse.ACCEPT, also for a robot that stands already (True is not "
    "GoalResponse.ACCEPT)."
)
FREE_AGAIN = "A goal before it has ended: in a finally block, remember that the robot is free again."
STANDS_ALREADY = (
    "A rejection carries no reason, so the client would never learn why: accept the goal, and abort it with "
    "ALREADY_STANDING."
)
UNKNOWN = "While nothing is known, reject: keep None until the first odom and the first wrench of each foot."
FLOOR = (
    "It cannot get up from a fall: reject the goal while robot_state.mode is FALLEN, or abort it with FELL."
)
TIME_IS_UP = "12 s are over: publish a zero Twist, and abort() with a sentence in error_msg."


def require_not_given_up(goal: Goal) -> None:
    """Require that a goal that could succeed was not ABORTED; its code says what to do."""
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
    """Return what to do about a goal that SUCCEEDED with the pelvis at a height (m) that is too low."""
    if height < height_at(run_of(goal), goal.accepted_at) + GAIN:
        return "It never rose: publish a Twist with linear.z above 0 on cmd_vel, again and again, at least every 0.5 s."
    return "Look at odom's pose.pose.position.z, and let the loop go on until it is 0.59 m."


def _why_blind(goal: Goal) -> str | None:
    """Return what to do if what the goal reports never changed, though the robot rose."""
    seen = [body.z for body in bodies(run_of(goal), goal.accepted_at, goal.run.end)]
    percents = {feedback.feedback.percent_complete for feedback in goal.feedback}
    if len(goal.feedback) < FROZEN or len(percents) > 1 or max(seen) < seen[0] + 0.05:
        return None
    return (
        f"percent_complete stayed {percents.pop():.0f} in all {len(goal.feedback)} feedback messages, though the robot "
        "rose: no message of odom is served while execute holds the only thread. Use MultiThreadedExecutor, or an "
        "async execute that awaits."
    )


def _about_an_abort(goal: Goal) -> str:
    assert goal.result
    code, at = goal.result.result.error_code, goal.result.t
    if code == StandUp.Result.ALREADY_STANDING:
        return "A crouching robot is on its feet, so robot_state.mode is STANDING: compare odom's height with 0.59 m."
    if code == StandUp.Result.FELL:
        return "It had not fallen. A push is no fall: abort with FELL when robot_state.mode is FALLEN, and not before."
    if at - goal.accepted_at > TIME_LIMIT - EARLY:
        return (
            f"The time limit ended it, with the pelvis at {height_at(run_of(goal), at):.2f} m. Publish cmd_vel in "
            "every round, as it holds for 0.5 s only, and look at what ends the phase that it was in."
        )
    return "Nothing was wrong with the robot: let it shift its weight and go on, up to the time limit."
