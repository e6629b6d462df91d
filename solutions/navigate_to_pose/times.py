"""navigation_time and estimated_time_remaining, compared with the time that the way took."""

from __future__ import annotations

from autograder.authoring.failure import expect
from autograder.authoring.feedback import require_feedback
from autograder.authoring.goal import SUCCEEDED, Goal
from autograder.authoring.missing import unseen

from .legs import Leg, at_moment, seconds, told, under_way

TIME_SLACK = 1.0  # s that a reported time may be off: feedback's period and delivery
FACTOR = 2.0


def require_good_estimate(goal: Goal) -> None:
    """Require that the estimated time is positive under way, and within a factor of 2 half way."""
    leg = Leg.of(goal)
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
        help="Divide what is left by the speed that the robot really has, and add the time of the last turn and of "
        "standing still."
        if estimate < left
        else "Divide what is left by the speed that the robot really has while it walks.",
        at=leg.half,
    )


def require_true_navigation_time(goal: Goal) -> None:
    """Require that navigation_time is the time since acceptance, until the goal has succeeded."""
    goal.require_accepted().require_result(SUCCEEDED)
    require_feedback(goal)
    start = goal.accepted_at
    reports = told(goal)
    if not reports or reports[-1].t - start < 2 * TIME_SLACK:
        raise unseen(goal.run, f"there was feedback on “{goal.name}” for a moment only")
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
