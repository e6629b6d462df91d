"""How the goals that a fetch sent ended, and that it waited for that."""

from __future__ import annotations

import itertools
import math

from autograder.authoring import events as ev
from autograder.authoring.failure import Failure, expect
from autograder.authoring.goal import Goal
from autograder.authoring.missing import unseen
from autograder.authoring.readiness import require_alive
from autograder.authoring.scripted_goal import ScriptedCancel, ScriptedGoal
from autograder.authoring.transcript import Transcript
from ros_runtime.message_constants import GoalStatus as StatusName
from ros_runtime.message_constants import name_of

from .children import children, run_of

AT_ONCE = 1.0  # s from a drop of the battery, or a request to cancel, to the request to cancel the child


def end_of(child: ScriptedGoal, run: Transcript) -> float | None:
    """Return when (s) a child was over, whoever ended it; None: it never was."""
    if child.finished:
        return child.finished.t
    if child.reply and not child.reply.accepted:
        return child.reply.t
    died = [event.t for event in run.all(ev.ActionWithdrawn) if event.server == child.received.server]
    return died[0] if died else None


def require_finished(goal: Goal, child: ScriptedGoal, status: int) -> ev.GoalFinished:
    """Require that the played action ended a child with a status (action_msgs/GoalStatus)."""
    if child.finished is None:
        require_alive(goal.run)
        raise unseen(goal.run, f"{child.name} of {child.received.action} did not end")
    if child.finished.status != status:
        raise Failure(
            expected=f"{child.received.action} to end {name_of(StatusName, status)}",
            observed=f"it ended {name_of(StatusName, child.finished.status)}"
            + (", because your server canceled it" if child.cancels else ""),
            help="Cancel a child only when fetch is canceled or preempted, when the battery is low and nothing is "
            "held, or when the child has been silent for 5 s.",
            at=child.finished.t,
        )
    return child.finished


def require_in_order(goal: Goal) -> None:
    """Require that each child was sent when the one before had ended."""
    sent = children(goal)
    for before, after in itertools.pairwise(sent):
        end = end_of(before, run_of(goal))
        expect(
            end is not None and end <= after.received.t,
            expected="one child at a time: a goal only when the one before has ended",
            observed=f"a goal to {after.received.action} while {before.received.action} was at work",
            help="Wait for the result of a child, also of one that you have canceled, before you send the next goal.",
            at=after.received.t,
        )


def require_no_more(goal: Goal, number: int, because: str) -> None:
    """Require that the server sent so many goals and no more."""
    sent = children(goal)
    if len(sent) > number:
        raise Failure(
            expected=f"no goal after that, because {because}",
            observed=f"a goal to {sent[number].received.action}",
            help="After each child, ask whether the fetch goes on: has it failed, is it canceled, is the battery low?",
            at=sent[number].received.t,
        )


def require_nothing_left(goal: Goal) -> None:
    """Require that fetch ended when the last of its children had: none is left at work."""
    result = goal.result
    assert result, "ask for its result first"
    for child in children(goal):
        if not child.is_accepted:
            continue
        end = end_of(child, run_of(goal))
        asked = (
            f"you asked to cancel it {len(child.cancels)} time(s)"
            if child.cancels
            else "you never canceled it"
        )
        expect(
            end is not None and end <= result.t,
            expected=f"fetch to end when {child.received.action} has ended",
            observed=f"{child.received.action} was still at work, and {asked}",
            help="Wait for the child's own result after cancel_goal_async(): the answer to the cancel says only that "
            "the server will try."
            if child.cancels
            else "Cancel the child that is at work, wait for its result, and only then make your own terminal call.",
            at=result.t,
        )


def require_child_canceled(
    goal: Goal, child: ScriptedGoal, since: float, because: str, within: float = AT_ONCE
) -> ScriptedCancel:
    """Require that the server asked to cancel a child soon after a moment (s), and not before; return the request."""
    if not child.cancels:
        require_alive(goal.run)
        raise Failure(
            expected=f"a request to cancel {child.received.action}, because {because}",
            observed="none",
            help="Keep the child's goal handle while it is at work, and call its cancel_goal_async()."
            if child.is_accepted
            else "The child was not accepted yet: remember the cancel, and send it when you have the goal handle.",
            at=since,
        )
    asked = child.cancels[0]
    expect(
        since <= asked.received.t <= since + within,
        expected=f"a request to cancel {child.received.action} within {within:g} s, because {because}",
        observed=f"it came {asked.received.t - since:.1f} s after that"
        if asked.received.t >= since
        else f"it came {since - asked.received.t:.1f} s before that",
        help="Look for what ends a fetch while you wait for the child, several times a second, not only afterwards.",
        at=asked.received.t,
    )
    expect(
        asked.received.goal == child.name,
        expected="a request to cancel this one goal",
        observed="one to cancel every goal" if not asked.received.goal else f"one for {asked.received.goal}",
        help="cancel_goal_async() of the child's goal handle cancels that goal alone. Others may use the robot, too.",
        at=asked.received.t,
    )
    return asked


def require_not_canceled(child: ScriptedGoal, because: str, help: str) -> None:
    """Require that the server let a child come to its own end."""
    expect(
        not child.cancels,
        expected=f"{child.received.action} to come to its own end, because {because}",
        observed="a request to cancel it",
        help=help,
        at=child.cancels[0].received.t if child.cancels else None,
    )


def last_heard(child: ScriptedGoal) -> float:
    """Return when (s) the server last heard of a child before it asked to cancel it."""
    until = child.cancels[0].received.t if child.cancels else math.inf
    heard = [event.t for event in child.feedback if event.t < until]
    if child.reply:
        heard.append(child.reply.t)
    return max(heard, default=child.received.t)
