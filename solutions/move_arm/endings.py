"""Advice on a valid goal that was aborted, from its error_code and from where the arm was."""

from __future__ import annotations

from autograder.authoring import ABORTED, Failure, Goal, error_name, lesson_on_the_end, why_rclpy_aborted

from .truth import plan_of, worst_at

GOAL_TOLERANCE = 0.05  # rad, where the goal says 0
ARRIVAL_TIME = 1.0  # s after the last point is due, in which the arm may still arrive
FOLLOWING_ERROR = 0.25  # rad; an arm that follows its trajectory stays within this
_PREEMPTED = (
    "There was no newer goal for this arm. Keep the newest goal of each arm, not one for both: only a goal with the "
    "same `arm` preempts another."
)
_NOT_SERVED = (
    "The robot published joint_states all the time, but the callback of your subscription did not run: each execute "
    "that sleeps blocks a thread. Use MultiThreadedExecutor(num_threads=6), or make execute async and await in it."
)


def tolerance_of(goal: Goal) -> float:
    """Return the distance (rad) from its last position within which each joint has to come."""
    return goal.request.goal_tolerance or GOAL_TOLERANCE


def require_not_given_up(goal: Goal, help: str = "") -> None:
    """Require that the server did not abort a valid goal.

    `help` is the advice if it did and the record suggests no better one.
    """
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
    """Return advice on a goal that was aborted, `help` if the record suggests no better one."""
    assert goal.result
    if unmeant := why_rclpy_aborted(goal):
        return unmeant
    match error_name(goal):
        case "PREEMPTED":
            return _PREEMPTED
        case "INVALID_JOINTS":
            return _NOT_SERVED
        case "GOAL_TOLERANCE_VIOLATED":
            return _why_missed(goal, help)
    joint, off = worst_at(goal, goal.result.t, plan_of(goal).at(goal.result.t))
    if off <= FOLLOWING_ERROR:
        return (
            f"In the simulator the largest error was {off:.2f} rad, of {joint}, so the arm followed its trajectory. "
            "Use an executor that runs the callback of joint_states while execute runs, and look up joints by name."
        )
    return help or (
        f"In the simulator, too, {joint} was {off:.2f} rad off its trajectory: the robot did not receive all of it. "
        "Publish the whole trajectory once on joint_trajectory, with every point and its time_from_start."
    )


def _why_missed(goal: Goal, help: str) -> str:
    """Return advice on a goal that was aborted with GOAL_TOLERANCE_VIOLATED."""
    assert goal.result
    plan = plan_of(goal)
    tolerance = tolerance_of(goal)
    joint, off = worst_at(goal, goal.result.t, plan.final())
    if off <= tolerance:
        meant = "0 rad, which means 0.05" if goal.request.goal_tolerance == 0 else f"{tolerance:g} rad"
        return help or (
            f"In the simulator the largest error was {off:.2f} rad, of {joint}, and goal_tolerance is {meant}. Compare "
            "the error of each joint with goal_tolerance."
        )
    if goal.result.t < plan.end + 0.7 * ARRIVAL_TIME:
        return (
            f"The goal was aborted {goal.result.t - plan.end:.1f} s after its last point was due, but the joints have "
            "1 s to arrive."
        )
    return help or (
        f"In the simulator, too, {joint} was {off:.2f} rad from the last point. Publish the whole trajectory once on "
        "joint_trajectory, and nothing that replaces it."
    )
