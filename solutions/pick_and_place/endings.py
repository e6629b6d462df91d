"""Checks how a goal ended: SUCCEEDED, or ABORTED with an error_code and a reason."""

from __future__ import annotations

from autograder.authoring import ABORTED, SUCCEEDED, Failure, Goal, error_name, ev, why_rclpy_aborted
from humanoid_interfaces.action import PickAndPlace

_ADVICE_ON_ABORTS = {
    "UNKNOWN_OBJECT": "objects/cup/pose is published ten times a second. On one thread, no callback runs while execute "
    "is in time.sleep: use MultiThreadedExecutor, or make execute async and await in it.",
    "UNREACHABLE": "Check your requests to compute_arm_ik: frame odom, the right arm, a hand that points ahead, a "
    "place above the table.",
    "GRASP_FAILED": "Close the hand only when it is open around the cup, 0.01 m above its centre. Compare force.y of "
    "r_gripper/wrench.",
    "DROPPED": "Close the fingers until the force is grasp_force before you lift. Do not report DROPPED while you put "
    "the cup down: the force may fall to 0 then.",
    "FELL": "Move the hand slowly, 0.2 m/s at most: moving it far and fast topples the robot.",
}


def require_succeeded(goal: Goal) -> ev.ResultReceived:
    """Require that a goal that can be carried out SUCCEEDED, and return its result."""
    goal.require_accepted()
    if goal.status == ABORTED and not why_rclpy_aborted(goal) and goal.result:
        said, code = goal.result.result, error_name(goal) or "no constant"
        raise Failure(
            expected="status SUCCEEDED",
            observed=f"status ABORTED, error_code {said.error_code} ({code}): {said.error_msg[:200]!r}",
            help=_ADVICE_ON_ABORTS.get(
                code, "This goal can be carried out: find out why your server aborted it."
            ),
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
