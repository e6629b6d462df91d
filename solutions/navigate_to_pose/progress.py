"""progress_percentage: from 0 to 100, never falling, about half at half way."""

from __future__ import annotations

from autograder.authoring import SUCCEEDED, Goal, expect
from autograder.authoring.walking.life import accepted, interrupted, phase
from ros_runtime.message_constants import GoalStatus, name_of

from .legs import Leg, at_moment, told

HALF_WAY = (25.0, 75.0)  # percent
COMPLETE = 99.5  # percent


def progress_rises(goal: Goal) -> str | None:
    """progress_percentage is 0 to 100, never falls, and is 100 in the last feedback before the goal SUCCEEDED."""
    if not accepted(goal) or interrupted(goal) or not (told(goal) or goal.status == SUCCEEDED):
        return None
    before = 0.0
    for feedback in told(goal):
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
        before >= COMPLETE or goal.status != SUCCEEDED,
        expected="100 percent in the last feedback of a goal that SUCCEEDED",
        observed=f"{before:.1f}",
        help="Publish one more feedback with progress_percentage 100 before succeed().",
        at=goal.result.t if goal.result else None,
    )
    return name_of(GoalStatus, goal.status) if goal.status else None


def half_done_half_way(goal: Goal) -> str | None:
    """progress_percentage is about half where half of the distance is left."""
    leg = Leg.of(goal)
    if leg is None:
        return None
    progress = at_moment(goal, leg.half).feedback.progress_percentage
    low, high = HALF_WAY
    expect(
        low <= progress <= high,
        expected=f"progress_percentage from {low:.0f} to {high:.0f} where half of the distance is left",
        observed=f"{progress:.1f}",
        help="Compare what is left, in metres or in seconds, with what was left when the goal was accepted.",
        at=leg.half,
    )
    return phase(goal)
