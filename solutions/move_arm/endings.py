"""Why an arm's goal was given up though it could be carried out: by its error_code, and by where the arm was."""

from __future__ import annotations

from autograder.authoring import ABORTED, Failure, Goal, error_name, lesson_on_the_end, why_rclpy_aborted

from .truth import plan_of, worst_at

GOAL_TOLERANCE = 0.05  # rad, where the goal says 0
ARRIVAL_TIME = 1.0  # s after the last point in which the arm may still arrive
FOLLOWING_ERROR = 0.25  # rad, off a trajectory that the arm follows
_PREEMPTED = (
    "Nobody has sent another goal for this arm. Remember the newest goal of each arm, not one for both: a goal gives "
    "way only to one with the same `arm`."
)
_DEAF = (
    "The robot published joint_states all the time, but nobody served your node's subscription: each execute that "
    "sleeps keeps a thread. Use a MultiThreadedExecutor(num_threads=6), or an async execute that awaits."
)


def tolerance_of(goal: Goal) -> float:
    """Return how near (rad) each joint has to come to its last point."""
    return goal.request.goal_tolerance or GOAL_TOLERANCE


def require_not_given_up(goal: Goal, help: str = "") -> None:
    """Require that the server did not abort a sound goal; `help`: if it did, and nothing in the record says more."""
    if goal.status != ABORTED:
        return
    assert goal.result
    result = goal.result.result
    code = error_name(goal) or result.error_code
    raise Failure(
        expected="status SUCCEEDED",
        observed=f"status ABORTED, error_code {code}, error_msg {result.error_msg!r}",
        help=why_given_up(goal, help),
        at=goal.result.t,
        see=lesson_on_the_end(goal),
    )


def why_given_up(goal: Goal, help: str = "") -> str:
    """Return what to do about a goal that was aborted; `help`: if nothing in the record says more."""
    assert goal.result
    if unmeant := why_rclpy_aborted(goal):
        return unmeant
    match error_name(goal):
        case "PREEMPTED":
            return _PREEMPTED
        case "INVALID_JOINTS":
            return _DEAF
        case "GOAL_TOLERANCE_VIOLATED":
            return _why_missed(goal, help)
    joint, off = worst_at(goal, goal.result.t, plan_of(goal).at(goal.result.t))
    if off <= FOLLOWING_ERROR:
        return (
            f"In the simulator {joint} was the worst joint then, and {off:.2f} rad off its trajectory. Are "
            "joint_states served while execute runs, and is each joint looked up by its name?"
        )
    return help or (
        f"In the simulator {joint} was {off:.2f} rad off its trajectory, too: the robot did not get all of it. Publish "
        "the whole trajectory once on joint_trajectory, with every point and its time_from_start."
    )


def _why_missed(goal: Goal, help: str) -> str:
    """Return what to do about a goal that its server aborted because of the goal's tolerance."""
    assert goal.result
    plan = plan_of(goal)
    tolerance = tolerance_of(goal)
    joint, off = worst_at(goal, goal.result.t, plan.final())
    if off <= tolerance:
        meant = "0 rad, which means 0.05" if goal.request.goal_tolerance == 0 else f"{tolerance:g} rad"
        return help or (
            f"In the simulator {joint} was the worst joint then, {off:.2f} rad from the last point, and goal_tolerance "
            f"is {meant}. Compare with that, joint by joint."
        )
    if goal.result.t < plan.end + 0.7 * ARRIVAL_TIME:
        return (
            f"That came {goal.result.t - plan.end:.1f} s after the last point's time, but a joint has 1 s more to get "
            "there."
        )
    return help or (
        f"In the simulator {joint} was {off:.2f} rad from the last point, too: the robot did not get all of the "
        "trajectory, or it was stopped."
    )
