"""Judges what the client does when somebody types q, and what it says about the answer."""

from __future__ import annotations

import re

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import (
    require_exit,
    require_goal_finished,
    require_no_cancel,
    require_one_goal,
    require_prompt_numbers,
    require_refused_cancel,
    require_said,
    require_single_cancel,
)
from autograder.authoring.failure import expect
from autograder.authoring.missing import unseen
from autograder.authoring.scripted_goal import ScriptedGoal
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    CANCELED,
    STATUS_HELP,
    WALK,
    GoalStatus,
    require_ending_line,
    require_success,
)

REFUSED = re.compile(
    r"refus|reject|declin|den(?:y|ied)|(?:not|n't|cannot) (?:be )?cancel|fail|terminated|already|too late",
    re.IGNORECASE,
)
PROMPT = 0.5  # s from a feedback message to its line
_ON_Q = (
    "Read stdin in a thread that sets an event; where you wait for the result, look at the event and call "
    "goal_handle.cancel_goal_async()."
)


def require_typed(run: Transcript) -> float:
    """Require that something was typed, or the input ended, and return when (s) that was first."""
    typed = run.first(ev.NodeTyped)
    if typed is None:
        raise unseen(run, "nothing was typed, because the goal never was under way")
    return typed.t


def require_canceled_by_q(run: Transcript, within: float, help: str = _ON_Q) -> ScriptedGoal:
    """Require that a q, and nothing before it, cancelled the goal once, and that its end was waited for."""
    goal = require_one_goal(run, WALK)
    typed = require_typed(run)
    cancel = require_single_cancel(run, goal, because="you typed q", help=help)
    expect(
        cancel.received.t >= typed,
        expected="the goal to go on until you type q",
        observed=f"a request to cancel {typed - cancel.received.t:.1f} s before",
        help="Cancel only when a line is q: not at the start, and not at the end of the input.",
        at=cancel.received.t,
    )
    finished = require_goal_finished(run, goal, GoalStatus.STATUS_CANCELED)
    exited = require_exit(
        run, within, CANCELED, because="the goal was CANCELED", stream="stdout", help=STATUS_HELP
    )
    require_ending_line(run, "CANCELED", exited.t)
    expect(
        exited.t >= finished.t,
        expected="the end of the program after the end of the goal",
        observed=f"{finished.t - exited.t:.1f} s before it",
        help="The server's answer says only that it will try: wait for the result.",
        at=exited.t,
    )
    return goal


def require_told_refusal(run: Transcript, return_code: int, *, when: str, help: str) -> ScriptedGoal:
    """Require one request to cancel that was refused with this code, and a line that says so before the end."""
    goal = require_one_goal(run, WALK)
    require_typed(run)
    require_single_cancel(run, goal, because="you typed q", help=_ON_Q)
    reply = require_refused_cancel(goal, run, return_code)
    exited = run.first(ev.NodeExited)
    require_said(
        run,
        REFUSED,
        reply.t - 0.05,
        exited.t if exited else run.end,
        expected=f"a line with the word refused, {when}",
        help=help,
    )
    return goal


def require_prompt_feedback(run: Transcript) -> None:
    """Require that each feedback message was printed soon after it came."""
    goal = require_one_goal(run, WALK)
    finished = require_goal_finished(run, goal, GoalStatus.STATUS_SUCCEEDED)
    sent = [
        (event.t, event.feedback.distance_remaining) for event in goal.feedback if event.t < finished.t - 0.3
    ]
    if len(sent) < 3:
        raise unseen(run, f"only {len(sent)} feedback messages were sent")
    require_prompt_numbers(
        run,
        sent,
        PROMPT,
        help="Something holds up the thread that spins, most likely the reading of stdin: input() and readline() wait "
        "for a whole line. Give it a thread of its own.",
    )


def require_agreed(run: Transcript, status: int) -> ScriptedGoal:
    """Require that a q cancelled the goal once, that the server agreed, and that it ended with another status."""
    goal = require_one_goal(run, WALK)
    require_typed(run)
    cancel = require_single_cancel(run, goal, because="you typed q", help=_ON_Q)
    if cancel.reply is None or goal.name not in cancel.reply.canceling:
        raise unseen(run, "the server did not agree to the cancel")
    require_goal_finished(run, goal, status)
    return goal


def require_walk_without_q(run: Transcript, within: float) -> None:
    """Require that what was typed, or the end of the input, cancelled nothing, and that the walk went on to its end."""
    goal = require_one_goal(run, WALK)
    require_typed(run)
    require_no_cancel(goal, because="nobody typed q")
    require_success(run, goal, within)
