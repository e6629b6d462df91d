"""Judges a client of `walk_to` whose server is missing, does not answer, falls silent or dies."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import (
    heard_last,
    how_to_give_up,
    require_cancel,
    require_goal_answered,
    require_one_goal,
    require_patience,
)
from autograder.authoring.failure import expect
from autograder.authoring.missing import unseen
from autograder.authoring.scripted_goal import ScriptedGoal
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import FINDING, NO_SERVER, PATIENCE, WALK, require_failure

GIVING_UP = 8.0  # s, of which 5 are waited


def require_no_server(run: Transcript, within: float) -> None:
    """Require that the program gave up because nobody offers the action."""
    if run.first(ev.ActionOffered):
        raise unseen(run, f"{WALK} was offered")
    require_failure(
        run,
        within,
        NO_SERVER,
        because=f"nobody offers {WALK}",
        help="wait_for_server(timeout_sec=5.0) returns False when there is none: print a line and return 1.",
    )
    started, exited = run.first(ev.NodeReady), run.first(ev.NodeExited)
    if started is None or exited is None:
        raise unseen(run, "no node appeared")
    expect(
        exited.t - started.t >= PATIENCE - FINDING,
        expected=f"{PATIENCE:g} s of waiting: a server that has just been started takes a while to be found",
        observed=f"it gave up after {exited.t - started.t:.1f} s",
        help="Call wait_for_server(timeout_sec=5.0) before you send the goal.",
        at=exited.t,
    )


def require_no_answer_noticed(run: Transcript) -> None:
    """Require that the program gave up 5 s after it had sent a goal that was never answered."""
    goal = require_one_goal(run, WALK)
    if goal.reply:
        raise unseen(run, "the goal was answered")
    require_failure(
        run,
        GIVING_UP + PATIENCE,
        NO_SERVER,
        because="the goal was never answered",
        help="spin_until_future_complete(node, future, timeout_sec=5.0) returns with no result: look at future.done().",
    )
    exited = run.first(ev.NodeExited)
    if exited:
        require_patience(run, goal.received.t, exited.t, PATIENCE, what="the end")


def require_silence_noticed(run: Transcript) -> None:
    """Require that the program cancelled a goal of which nothing was heard after the acceptance."""
    goal = require_one_goal(run, WALK)
    accepted = require_goal_answered(run, goal, accepted=True)
    if goal.finished and not goal.cancels:
        raise unseen(run, "the goal ended by itself")
    _require_gives_up_in_silence(run, goal, max(accepted, heard_last(run, goal)))


def require_silence_on_the_way_noticed(run: Transcript) -> None:
    """Require that the program cancelled a goal of which there had been feedback and then nothing more."""
    _require_gives_up_in_silence(run, require_one_goal(run, WALK), _heard_last_feedback(run))


def _require_gives_up_in_silence(run: Transcript, goal: ScriptedGoal, since: float) -> None:
    """Require that 5 s after the last word of the server the client cancels the goal and ends with status 1."""
    cancel = require_cancel(
        run,
        goal,
        because=f"nothing was heard of it for {PATIENCE:g} s",
        help=how_to_give_up(run),
    )
    require_patience(run, since, cancel.received.t, PATIENCE, what="a request to cancel")
    require_failure(
        run,
        cancel.received.t + PATIENCE,
        NO_SERVER,
        because="the server is silent",
        help="Give the waiting for the result a limit on silence, and return 1 when it is over.",
    )


def require_death_noticed(run: Transcript) -> None:
    """Require that the program gave up when the server had died on the way, whatever it still waited for."""
    if run.first(ev.ActionWithdrawn) is None:
        raise unseen(run, "the server did not die, because the goal never was under way")
    exited = run.first(ev.NodeExited)
    require_failure(
        run,
        GIVING_UP + 3 * PATIENCE,
        NO_SERVER,
        because="the server has died",
        help="A server that has died answers nothing, no cancel either: give each wait a time limit.",
    )
    if exited:
        since = _heard_last_feedback(run)
        expect(
            PATIENCE - 0.5 <= exited.t - since <= 2 * PATIENCE + 2.0,
            expected=f"the end {PATIENCE:g} s after the last feedback, and at most {PATIENCE:g} s more for the cancel",
            observed=f"{exited.t - since:.1f} s after it",
            help="Note when feedback came last; wait for the answer to the cancel with a time limit, too.",
            at=exited.t,
        )


def _heard_last_feedback(run: Transcript) -> float:
    """Return when (s) the last feedback was sent."""
    sent = run.all(ev.FeedbackSent)
    if not sent:
        raise unseen(run, "no feedback was sent")
    return sent[-1].t
