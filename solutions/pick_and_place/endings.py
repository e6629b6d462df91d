"""Judges how a goal ended: SUCCEEDED, or ABORTED with a code and a reason."""

from __future__ import annotations

from autograder.authoring import ABORTED, SUCCEEDED, Failure, Goal, error_name, ev, why_rclpy_aborted
from humanoid_interfaces.action import PickAndPlace

_WHY_IT_GAVE_UP = {
    "UNKNOWN_OBJECT": "objects/cup/pose comes ten times a second. Is anything of your node served while execute "
    "waits? On one thread time.sleep keeps every message out: use MultiThreadedExecutor, or an async execute that "
    "awaits.",
    "UNREACHABLE": "Look at what you asked of compute_arm_ik: frame odom, the right arm, a hand that points ahead, a "
    "place above the table.",
    "GRASP_FAILED": "Was the open hand around the cup, 0.01 m above its centre, before it closed? And is the force "
    "that you compare force.y of r_gripper/wrench?",
    "DROPPED": "Let the fingers press with grasp_force before you lift. And when you put the cup down, the force may "
    "vanish: nothing is lost then.",
    "FELL": "Move the hand slowly, 0.2 m/s at most: a long reach in a jerk topples the robot.",
}


def require_succeeded(goal: Goal) -> ev.ResultReceived:
    """Require that a goal that can be carried out SUCCEEDED, and return its result."""
    goal.require_accepted()
    if goal.status == ABORTED and not why_rclpy_aborted(goal) and goal.result:
        said, code = goal.result.result, error_name(goal) or "no constant"
        raise Failure(
            expected="status SUCCEEDED",
            observed=f"status ABORTED, error_code {said.error_code} ({code}): {said.error_msg[:200]!r}",
            help=_WHY_IT_GAVE_UP.get(code, "This goal can be carried out: find out why your server gave up."),
            at=goal.result.t,
        )
    return goal.require_result(SUCCEEDED)


def require_aborted(goal: Goal, code: str, *, because: str, help: str) -> ev.ResultReceived:
    """Require that a goal was ABORTED with an error_code and a reason, and return the result."""
    goal.require_accepted()
    result = goal.require_result(ABORTED, help=help)
    goal.expect(
        "error_code",
        getattr(PickAndPlace.Result, code),
        because=f"{because}: {code}",
        help=why_rclpy_aborted(goal) or f"It ended with {error_name(goal) or 'no constant'}. {help}",
    )
    goal.require_reason()
    return result
