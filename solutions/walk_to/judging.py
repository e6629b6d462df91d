"""Judges what the server says to a goal: whether it is rejected, and for the reason that the scenario gave it."""

from __future__ import annotations

from collections.abc import Callable

from autograder.authoring.failure import expect
from autograder.authoring.goal import Goal
from autograder.authoring.goal_endings import why_rclpy_aborted
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript


def require_rejected_until(
    run: Transcript,
    refused: str,
    accepted: str,
    *,
    published: str,
    holds: Callable[[int], bool],
    because: str,
    help: str,
) -> None:
    """Require that one goal is rejected, and another accepted as soon as the reason is gone.

    Args:
        run: with a robot that the scenario plays.
        refused: name of the goal that must be rejected.
        accepted: name of the goal that comes when the reason is gone.
        published: the topic that makes the difference.
        holds: tells whether the goal had to be rejected after so many messages on it with which all is well.
        because: why the goal has to be rejected.
        help: what to do if it was accepted.
    """
    goal, later = run.goal(refused), run.goal(accepted)
    if not holds(_good_messages(run, published, goal)) or holds(_good_messages(run, published, later)):
        raise unseen(run, f"{published} was not published as the scenario has it")
    goal.require_rejected(because=because, help=help)
    later.require_accepted(
        f"Now nothing is wrong any more: look at the last {published} when the goal comes, not at the first."
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


def _good_messages(run: Transcript, topic: str, goal: Goal) -> int:
    """Count the messages on a topic before a goal that let it be accepted and reached somebody."""
    return sum(
        event.t < goal.sent.t and event.subscriptions > 0 and getattr(event.message, "motors_enabled", True)
        for event in run.published(topic)
    )
