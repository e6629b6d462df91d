"""Requirements on the feedback of a goal: its existence, its rate and its gaps."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from autograder.authoring.diagnosis.goal_diagnosis import why_rclpy_aborted
from autograder.authoring.diagnosis.missing import Missing, ordinal
from autograder.authoring.evidence.goal import Goal
from autograder.authoring.failure import expect

MIN_RATE, MAX_RATE = 3.0, 10.0  # Hz; the task asks for 5
MIN_MESSAGES = 3  # to measure a rate
RATE_SLACK = 0.5  # Hz of measuring error over a short walk
MAX_GAP = 1.0  # s
END_SLACK = 0.5  # s by which the gap before the result may be longer


def require_feedback(goal: Goal) -> None:
    """Require that the goal was accepted and that there was feedback on it."""
    goal.require_accepted()
    expect(
        len(goal.feedback) > 0,
        expected="feedback",
        observed="none",
        help="Publish feedback while the goal is active.",
    )


def require_good_feedback_rate(
    goal: Goal, *, wanted: float = 5.0, lowest: float = MIN_RATE, highest: float = MAX_RATE
) -> None:
    """Require feedback at a mean rate (Hz) without a gap over 1 s, from the answer to the result.

    Args:
        goal: which was accepted.
        wanted: the rate that the task asks for.
        lowest: the least mean rate that passes.
        highest: the greatest.
    """
    start = goal.accepted_at
    times = [feedback.t for feedback in goal.feedback if goal.result is None or feedback.t <= goal.result.t]
    ended_early = goal.result is not None and goal.result.t < start + MIN_MESSAGES / lowest
    expect(
        len(times) >= MIN_MESSAGES,
        expected=f"feedback about {wanted:.0f} times a second while the robot moves",
        observed=f"{len(times)} message(s)" + (", and the goal ended at once" if ended_early else ""),
        help=why_rclpy_aborted(goal)
        or ("First correct how the goal ends: it was over before feedback was due." if ended_early else "")
        or "Call goal_handle.publish_feedback(feedback), with the action's Feedback, in the loop of execute.",
        at=start,
    )
    rate = (len(times) - 1) / max(times[-1] - times[0], 1e-6)
    expect(
        lowest - RATE_SLACK <= rate <= highest + RATE_SLACK,
        expected=f"feedback at {wanted:.0f} Hz ({lowest:.0f} to {highest:.0f} Hz on average)",
        observed=f"{rate:.1f} Hz",
        help=f"Publish every {1 / wanted:g} s: a loop with time.sleep(0.05) publishes in every "
        f"{ordinal(round(20 / wanted))} round.",
        at=times[0],
    )
    _require_no_gap([start, *times], MAX_GAP)
    _require_no_gap([times[-1], end_of_feedback(goal)], MAX_GAP + END_SLACK)


def end_of_feedback(goal: Goal) -> float:
    """Require feedback, and return when (s) it may end: at the result, or, if none was awaited, at its last message."""
    require_feedback(goal)
    if goal.result:
        return goal.result.t
    if goal.run.given_up("result", goal.name):
        return goal.feedback[-1].t
    raise Missing(
        goal.run, expected=f"feedback until the goal “{goal.name}” ends", never="its end was never awaited"
    )


def _require_no_gap(times: Sequence[float], longest: float) -> None:
    gap, at = max((later - earlier, earlier) for earlier, later in pairwise(times))
    expect(
        gap <= longest,
        expected=f"no gap over {MAX_GAP:.0f} s in the feedback",
        observed=f"a gap of {gap:.1f} s",
        help="The loop waits somewhere: publish feedback also while the robot turns, slows down or settles.",
        at=at,
    )
