"""Detours: the robot finds its way back, and number_of_recoveries counts that once, and nothing else."""

from __future__ import annotations

from autograder.authoring import Goal, expect, not_shown
from autograder.authoring.walking.life import accepted, interrupted, phase
from autograder.authoring.walking.truth import require_arrival

from .legs import led_astray, operated, told

MOST_DETOURS = 3  # one is right; who counts the turn back and the walk back as two is right, too


def finds_its_way_back(goal: Goal) -> str | None:
    """Led back and turned by a remote control, the robot finds its way again, and arrives."""
    if led_astray(goal) is None:
        return None
    require_arrival(goal)
    return "led astray"


def counts_no_recovery(goal: Goal) -> str | None:
    """number_of_recoveries stays 0 while nothing disturbs the robot, also after a goal on whose way something did."""
    if not accepted(goal) or interrupted(goal) or operated(goal) or not told(goal):
        return None
    counted = max(told(goal), key=lambda feedback: feedback.feedback.number_of_recoveries)
    expect(
        counted.feedback.number_of_recoveries == 0,
        expected="number_of_recoveries 0: nothing disturbed the robot on the way to this goal",
        observed=f"{counted.feedback.number_of_recoveries}",
        help="Count for each goal anew. The turn at the start is no recovery, nor is a bearing that swings when the "
        "goal is a step away: count only when the robot walks, farther than 0.3 m from the goal, and is off by more "
        "than 0.5 rad.",
        at=counted.t,
    )
    return phase(goal)


def counts_the_detour(goal: Goal) -> str | None:
    """number_of_recoveries counts a detour, once."""
    moments = led_astray(goal)
    if moments is None:
        return None
    taken, given = moments
    counts = [each.feedback.number_of_recoveries for each in told(goal)]
    early = [each.feedback.number_of_recoveries for each in told(goal) if each.t < taken]
    expect(
        not early or early[-1] == 0,
        expected="number_of_recoveries 0 until something disturbs the robot",
        observed=f"{early[-1] if early else 0}",
        help="The turn at the start is no recovery.",
        at=taken,
    )
    if not counts:
        raise not_shown(goal.run, f"feedback on “{goal.name}” comes before its result")
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
    return "led astray"
