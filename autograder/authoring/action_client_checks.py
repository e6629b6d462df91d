"""Requirements on a client of a scripted action: what it sent, whom it cancelled, how it ended, what it printed."""

from __future__ import annotations

import re

from autograder.authoring import events as ev
from autograder.authoring.client_checks import require_end
from autograder.authoring.failure import Failure, expect
from autograder.authoring.missing import Missing, unseen
from autograder.authoring.scripted_goal import ScriptedCancel, ScriptedGoal
from autograder.authoring.transcript import Transcript

GAVE_UP = 1  # the exit status of a client that has heard nothing for too long
LIVELY = 4.0  # s since the last feedback, in which a goal is not silent yet
MANY_NUMBERS = 20  # in one line
NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?")

_LOST_STATUS = (
    "It says why, but its status got lost: return it from main(), and end the file with sys.exit(main())."
)
_HELD_INPUT = "could not acquire lock for <_io.BufferedReader name='<stdin>'>"
_NO_INPUT = (
    "A daemon thread still stood in input() when the program ended, and Python aborts there: read with "
    "`for line in sys.stdin` instead."
)


def require_one_goal(run: Transcript, action: str) -> ScriptedGoal:
    """Require that the client sent exactly one goal, and return it."""
    if not any(event.action == action for event in run.all(ev.ActionOffered)):
        raise unseen(run, f"{action} was not offered")
    goals = run.scripted_goals(action)
    if not goals:
        raise Missing(run, expected=f"a goal for {action}", never="no goal ever came")
    expect(
        len(goals) == 1,
        expected=f"one goal for {action}",
        observed=f"{len(goals)}",
        help="Send the goal once, and follow that one to its end: a second goal would take the robot from the first.",
        at=goals[-1].received.t,
    )
    return goals[0]


def require_goal_answered(run: Transcript, goal: ScriptedGoal, *, accepted: bool) -> float:
    """Require that the grader accepted or rejected the goal, and return when (s)."""
    if goal.reply is None:
        raise Missing(
            run, expected="a client that waits for the answer to its goal", never="it was never answered"
        )
    if goal.reply.accepted != accepted:
        raise unseen(run, f"the goal was {'accepted' if goal.reply.accepted else 'rejected'}")
    return goal.reply.t


def require_goal_finished(run: Transcript, goal: ScriptedGoal, status: int) -> ev.GoalFinished:
    """Require that the goal came to its end with a status of action_msgs/GoalStatus while the client was there."""
    exited = run.first(ev.NodeExited)
    crashed = exited is None or exited.returncode < 0 or "Traceback (most recent" in run.output("stderr")
    left = exited is not None and (goal.finished is None or exited.t < goal.finished.t)
    if exited and left and goal.is_accepted and not crashed:
        raise Failure(
            expected="a client that follows the goal to its end",
            observed=f"it ended with status {exited.returncode} at {exited.t:.1f} s, while the goal was under way",
            help=why_it_left(goal, exited),
            at=exited.t,
        )
    if goal.finished is None or goal.finished.status != status:
        gone = exited.t if exited else run.end
        raise Missing(
            run,
            expected="a client that follows the goal to its end",
            never=f"at {gone:.1f} s it was gone already",
        )
    return goal.finished


def why_it_left(goal: ScriptedGoal, exited: ev.NodeExited) -> str:
    """Return what to do about a client that left its goal, by what it was told last."""
    heard = [feedback.t for feedback in goal.feedback if feedback.t < exited.t]
    if exited.returncode == GAVE_UP and heard and exited.t - heard[-1] < LIVELY:
        return (
            f"It gave up, though feedback came until {heard[-1]:.1f} s: a goal may take its time, only silence has a "
            "limit, counted from the last feedback."
        )
    reply = goal.cancels[0].reply if goal.cancels else None
    if reply and not reply.canceling:
        return (
            "The cancel was refused: goals_canceling is empty. So the goal goes on, and you wait for its result "
            "before you return."
        )
    if reply:
        return "The answer to a cancel says only that the server will try: wait for the result before you return."
    if goal.cancels:
        return "A cancel that has been sent is not an end: wait for the result before you return."
    if goal.result_requested is None:
        return "It never asked for the result: call goal_handle.get_result_async(), and wait for its future."
    return "After the acceptance, wait for the future of get_result_async() before you return."


def require_cancel(run: Transcript, goal: ScriptedGoal, *, because: str, help: str) -> ScriptedCancel:
    """Require that the client asked to cancel the goal, and return the first request."""
    if not goal.cancels:
        raise Failure(
            expected=f"a request to cancel the goal, because {because}",
            observed="none: the robot walks on, and nobody watches it",
            help=help,
            at=run.end,
        )
    return goal.cancels[0]


def how_to_give_up(run: Transcript) -> str:
    """Return what to do about a client that did not cancel a goal of which nothing was heard any more."""
    cancel = "call goal_handle.cancel_goal_async(), and spin until it is sent"
    if run.first(ev.NodeExited):
        return f"It ended, and the robot walks on: before you give up on a goal that was accepted, {cancel}."
    return (
        "It still waited for the result when the scenario was over: note when feedback came last, and after 5 s "
        f"without any {cancel}."
    )


def require_single_cancel(run: Transcript, goal: ScriptedGoal, *, because: str, help: str) -> ScriptedCancel:
    """Require that the client asked to cancel the goal, that one and once, and return the request."""
    cancel = require_cancel(run, goal, because=because, help=help)
    expect(
        len(goal.cancels) == 1,
        expected="one request to cancel the goal",
        observed=f"{len(goal.cancels)}",
        help="Remember that you have asked: the server works on the first request already.",
        at=goal.cancels[-1].received.t,
    )
    expect(
        cancel.received.goal == goal.name,
        expected="a request to cancel this goal",
        observed="one without an id, which cancels the goals of all clients",
        help="Call cancel_goal_async() of the goal handle that you were given.",
        at=cancel.received.t,
    )
    return cancel


def require_refused_cancel(goal: ScriptedGoal, run: Transcript, return_code: int) -> ev.CancelReplySent:
    """Require that the first request to cancel got a reply with this code and no goal, and return the reply."""
    reply = goal.cancels[0].reply if goal.cancels else None
    if reply is None or reply.canceling or reply.return_code != return_code:
        raise unseen(run, "the cancel was not refused")
    return reply


def require_no_cancel(goal: ScriptedGoal, *, because: str) -> None:
    """Require that the client cancelled nothing."""
    if goal.cancels:
        raise Failure(
            expected=f"no request to cancel: {because}",
            observed=f"one came {goal.cancels[0].received.t - goal.received.t:.1f} s after the goal",
            help="Cancel only when you are asked to, or when nothing has been heard for too long.",
            at=goal.cancels[0].received.t,
        )


def why_not_this_status(run: Transcript, exited: ev.NodeExited, help: str) -> tuple[str, str]:
    """Return how it ended with a status that is not the right one, and what to do: `help`, if nothing else shows."""
    if _HELD_INPUT in run.output("stderr"):
        return f"exit status {exited.returncode}; Python aborted", _NO_INPUT
    lost = exited.returncode == 0 and bool(run.last_words)  # it failed and said so, but not with its status
    said = f"exit status {exited.returncode}; the last line on stderr: {run.last_words or 'none'}"
    return said, _LOST_STATUS if lost else help


def require_exit(
    run: Transcript, within: float, status: int, *, because: str, stream: str, help: str
) -> ev.NodeExited:
    """Require that the program ended in time with a status and a line on a stream, and printed no traceback."""
    exited = require_end(run, within)
    observed, help = why_not_this_status(run, exited, help)
    expect(
        exited.returncode == status,
        expected=f"exit status {status}: {because}",
        observed=observed,
        help=help,
        at=exited.t,
    )
    expect(
        "Traceback (most recent call last)" not in run.output("stderr"),
        expected="one line that says how it ended",
        observed=f"a traceback: {run.last_words}",
        help="An expected end is no crash: catch the exception, print one line, return the status.",
        at=exited.t,
    )
    expect(
        bool(run.output(stream).strip()),
        expected=f"one line on {stream} that says how it ended",
        observed=f"nothing on {stream}",
        help=f"print({'...' if stream == 'stdout' else '..., file=sys.stderr'}) before the program ends.",
        at=exited.t,
    )
    return exited


def has_number(line: str, number: float) -> bool:
    """Return whether a number, rounded to 0.01 or better, stands in a line that is not a whole table of them."""
    numbers = NUMBER.findall(line)
    return len(numbers) <= MANY_NUMBERS and any(abs(float(found) - number) <= 0.0101 for found in numbers)
