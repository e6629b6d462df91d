"""How the fetch itself ended, and how soon."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.failure import Failure, expect
from autograder.authoring.fields import shown
from autograder.authoring.goal import ABORTED, CANCELED, SUCCEEDED, Goal
from autograder.authoring.goal_endings import why_rclpy_aborted
from autograder.authoring.scripted_goal import ScriptedGoal

from .child_endings import (
    require_child_canceled,
    require_finished,
    require_in_order,
    require_no_more,
    require_nothing_left,
)
from .children import (
    require_child,
    require_pick,
    require_put_aside,
    require_put_down,
    require_walk_home,
    require_walk_to_the_table,
)

SILENCE = 5.0  # s that a client waits
NEXT = 2.0  # s from the end of a child to what follows from it
EARLY, LATE = 0.5, 2.5  # s that SILENCE may be missed by


def require_success(goal: Goal) -> None:
    """Require the four steps, and SUCCEEDED."""
    require_steps(goal)
    for step in range(1, 5):
        require_finished(goal, require_child(goal, step), SUCCEEDED)
    goal.require_result(SUCCEEDED)
    require_in_order(goal)
    require_no_more(goal, 4, "all is done")
    require_nothing_left(goal)


def require_steps(goal: Goal, last: int = 4) -> None:
    """Require that the first steps, up to the `last` one, were asked for rightly."""
    for step in range(1, last + 1):
        child = require_child(goal, step)
        if step % 2 == 0:
            require_pick(child, goal.request)
        match step:
            case 1:
                require_walk_to_the_table(child)
            case 2:
                require_put_aside(child, goal.request)
            case 3:
                require_walk_home(child)
            case 4:
                require_put_down(child, goal.request)


def require_abort(goal: Goal, *words: str, because: str) -> ev.ResultReceived:
    """Require ABORTED, by execute itself, with an error_msg that holds these words."""
    result = goal.require_result(ABORTED)
    if unmeant := why_rclpy_aborted(goal):
        raise Failure(
            expected="your own abort(), with the reason in error_msg",
            observed="rclpy aborted the goal",
            help=unmeant,
            at=result.t,
        )
    said = result.result.error_msg
    missing = [word for word in words if word.lower() not in said.lower()]
    expect(
        not missing,
        expected=f"an error_msg that holds {' and '.join(map(shown, words))}, because {because}",
        observed=f"error_msg: {shown(said)}",
        help="Fill result.error_msg with what happened, in words, before you call abort().",
        at=result.t,
    )
    return result


def require_soon(goal: Goal, since: float, what: str, within: float = NEXT) -> None:
    """Require that fetch ended soon (s) after something."""
    result = goal.result
    assert result, "ask for its result first"
    expect(
        result.t <= since + within,
        expected=f"the end of fetch within {within:g} s of {what}",
        observed=f"{result.t - since:.1f} s after it",
        help="Make the terminal call and return as soon as nothing is left to wait for.",
        at=result.t,
    )


def require_failed_child(goal: Goal, step: int, *words: str, because: str) -> ScriptedGoal:
    """Require that a fetch ended ABORTED with the reason why the child of a step failed, and sent no goal after it."""
    child = require_child(goal, step)
    require_in_order(goal)
    require_no_more(goal, step, because)
    require_abort(goal, child.received.action, *words, because=because)
    return child


def require_patience(goal: Goal, child: ScriptedGoal, since: float, what: str) -> None:
    """Require that a child was given 5 s of silence, not much shorter and not much longer."""
    gave_up = child.cancels[0].received.t if child.cancels else goal.require_result(ABORTED).t
    waited = gave_up - since
    expect(
        SILENCE - EARLY <= waited <= SILENCE + LATE,
        expected=f"patience of {SILENCE:g} s with {child.received.action} ({what})",
        observed=f"it was given up after {waited:.1f} s",
        help="Count the silence from the last thing that was heard of the child: its acceptance, or feedback.",
        at=gave_up,
    )


def require_canceled(goal: Goal, child: ScriptedGoal) -> None:
    """Require that a cancel of fetch went down to the child at work, and that CANCELED came after the child's end."""
    request = goal.requests_to_cancel[-1]
    request.require_agreed(goal)
    since = request.sent.t
    because = "fetch was canceled"
    if child.reply and child.reply.t > since:
        since, because = child.reply.t, "fetch was canceled before it was accepted"
    require_child_canceled(goal, child, since, because)
    require_in_order(goal)
    goal.require_result(CANCELED)
    require_nothing_left(goal)
