"""progress_percentage: from 0 to 100, never falling, about half at half way."""

from __future__ import annotations

from autograder.authoring.failure import expect
from autograder.authoring.feedback import require_feedback
from autograder.authoring.goal import SUCCEEDED, Goal

from .legs import Leg, at_moment

HALF_WAY = (25.0, 75.0)  # percent
COMPLETE = 99.5  # percent


def require_rising_progress(goal: Goal) -> None:
    """Require that progress_percentage is 0 to 100, never falls, and is 100 when the goal has succeeded."""
    end = goal.require_accepted().require_result(SUCCEEDED)
    require_feedback(goal)
    before = 0.0
    for feedback in goal.feedback:
        progress = float(feedback.feedback.progress_percentage)
        expect(
            0.0 <= progress <= 100.01,
            expected="progress_percentage from 0 to 100",
            observed=f"{progress:g}",
            help="0/0 is NaN where nothing is left to walk, and a longer way than at first is below 0: clamp it.",
            at=feedback.t,
        )
        expect(
            progress >= before - 0.01,
            expected="progress_percentage never to fall",
            observed=f"{progress:.1f} after {before:.1f}",
            help="A detour makes the way longer, and sway does so with every step: publish the largest value so far.",
            at=feedback.t,
        )
        before = progress
    expect(
        before >= COMPLETE,
        expected="100 percent in the last feedback of a goal that SUCCEEDED",
        observed=f"{before:.1f}",
        help="Publish one more feedback with progress_percentage 100 before succeed().",
        at=end.t,
    )


def require_half_done_half_way(goal: Goal) -> None:
    """Require that the progress half way is about half."""
    leg = Leg.of(goal)
    progress = at_moment(goal, leg.half).feedback.progress_percentage
    low, high = HALF_WAY
    expect(
        low <= progress <= high,
        expected=f"progress_percentage from {low:.0f} to {high:.0f} where half of the distance is left",
        observed=f"{progress:.1f}",
        help="Compare what is left, in metres or in seconds, with what was left when the goal was accepted.",
        at=leg.half,
    )
