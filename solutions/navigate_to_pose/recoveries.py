"""number_of_recoveries: none without a disturbance, one after it."""

from __future__ import annotations

from autograder.authoring.failure import expect
from autograder.authoring.feedback import require_feedback
from autograder.authoring.goal import Goal
from autograder.authoring.missing import unseen

from .legs import off_the_way, told

OFF_ITS_WAY = 0.6  # rad between heading and goal: more than the task's 0.5, so that nobody may overlook it
MOST_DETOURS = 3  # one is right; who counts the turn back and the walk back as two is right, too


def require_no_detour(goal: Goal) -> None:
    """Require that no recovery is counted on a way without a disturbance."""
    require_feedback(goal)
    counted = max(goal.feedback, key=lambda feedback: feedback.feedback.number_of_recoveries)
    expect(
        counted.feedback.number_of_recoveries == 0,
        expected="number_of_recoveries 0: nothing disturbed the robot",
        observed=f"{counted.feedback.number_of_recoveries}",
        help="The turn at the start is no recovery, nor is a bearing that swings when the goal is a step away: count "
        "only when the robot walks, farther than 0.3 m from the goal, and is off by more than 0.5 rad.",
        at=counted.t,
    )


def require_led_astray(goal: Goal) -> tuple[float, float]:
    """Return when the robot was taken over and given back; it must then have been off its way by more than 0.5 rad."""
    run = goal.run
    taken, given = run.told("take_over", velocity=[-0.2, 0.0, 0.0]), run.told("take_over", velocity=None)
    off = off_the_way(run.robot_at(given.t), goal)
    if off < OFF_ITS_WAY:
        raise unseen(run, f"the robot was only {off:.1f} rad off its way when it was given back")
    return taken.t, given.t


def require_detour_counted(goal: Goal) -> None:
    """Require that a recovery is counted once the robot has been led astray, and not before."""
    taken, given = require_led_astray(goal)
    require_feedback(goal)
    early = [f for f in goal.feedback if f.t < taken]
    counts = [f.feedback.number_of_recoveries for f in told(goal)]
    expect(
        not early or early[-1].feedback.number_of_recoveries == 0,
        expected="number_of_recoveries 0 until something disturbs the robot",
        observed=f"{early[-1].feedback.number_of_recoveries if early else 0}",
        help="The turn at the start is no recovery.",
        at=taken,
    )
    if not counts:
        raise unseen(goal.run, f"there was no feedback on “{goal.name}” before its result")
    expect(
        1 <= counts[-1] <= MOST_DETOURS,
        expected="number_of_recoveries 1 after the robot was led astray once",
        observed=f"{counts[-1]}",
        help="Count where the walking phase changes back to turning, not in every round of the loop."
        if counts[-1]
        else "While it walks, compare the goal's bearing with the heading: beyond 0.5 rad go back to the turning phase "
        "and add 1.",
        at=given,
    )
    expect(
        sorted(counts) == counts,
        expected="number_of_recoveries never to fall",
        observed=f"{counts}",
        help="Count for the whole goal.",
        at=given,
    )
