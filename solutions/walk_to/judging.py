"""Judges what the server says to a goal: whether it is rejected, and for the reason that the scenario gave it."""

from __future__ import annotations

from autograder.authoring.failure import expect
from autograder.authoring.goal import Goal
from autograder.authoring.goal_endings import why_rclpy_aborted
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript


def require_rejected_until(
    run: Transcript, refused: str, accepted: str, *, topic: str, because: str, help: str
) -> None:
    """Require that one goal is rejected, and another accepted as soon as the reason is gone.

    Args:
        run: with a robot that the scenario plays.
        refused: name of the goal that must be rejected.
        accepted: name of the goal that comes when the reason is gone.
        topic: on which a message that lets goals be accepted was published between the two.
        because: why the goal has to be rejected.
        help: what to do if it was accepted.
    """
    goal, later = run.goal(refused), run.goal(accepted)
    good = [event for event in run.published(topic) if getattr(event.message, "motors_enabled", True)]
    between = [event for event in good if goal.sent.t < event.t < later.sent.t]
    if not between or good[0] is not between[0]:
        raise unseen(run, f"{topic} was not published as the scenario has it")
    goal.require_rejected(because=because, help=help)
    expect(
        between[-1].subscriptions > 0,
        expected=f"a subscription to {topic}",
        observed="the grader published it, and nobody was subscribed",
        help=f'create_subscription(…, "{topic}", …), a relative name.',
        at=between[-1].t,
    )
    later.require_accepted(
        f"Now nothing is wrong any more: look at the last {topic} when the goal comes, not at the first."
    )


def require_under_way(goal: Goal, *, at: float) -> None:
    """Require that a goal 2 m away had not ended by a time (s) just after the robot began to walk."""
    result = goal.result
    expect(
        result is None or result.t > at,
        expected="a goal that is still active when the request to cancel comes",
        observed=f"it had ended at {result.t:.1f} s" if result else "",
        help=why_rclpy_aborted(goal) or "A walk of 2 m takes longer: end the goal when the robot is there.",
        at=at,
    )


def require_undisturbed(goal: Goal, *, what: str, at: float, help: str) -> None:
    """Require that a goal was active when something came, at `at` s, and went on to the scenario's end."""
    result = goal.require_accepted().result
    expect(
        result is None,
        expected=f"the first goal to go on after {what}",
        observed=f"it ended at {result.t:.1f} s" if result else "",
        help=help,
        at=result.t if result else at,
    )
