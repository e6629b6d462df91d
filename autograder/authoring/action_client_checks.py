"""What every client of a scripted action owes, and why one ended early, hung, or ended with a wrong status."""

from __future__ import annotations

import re

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.missing import Missing, unseen
from autograder.authoring.scripted_goal import ScriptedGoal
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


def how_to_give_up(run: Transcript) -> str:
    """Return what to do about a client that did not cancel a goal of which nothing was heard any more."""
    cancel = "call goal_handle.cancel_goal_async(), and spin until it is sent"
    if run.first(ev.NodeExited):
        return f"It ended, and the robot walks on: before you give up on a goal that was accepted, {cancel}."
    return (
        "It still waited for the result when the scenario was over: note when feedback came last, and after 5 s "
        f"without any {cancel}."
    )


def why_not_this_status(run: Transcript, exited: ev.NodeExited, help: str) -> tuple[str, str]:
    """Return how it ended with a status that is not the right one, and what to do: `help`, if nothing else shows."""
    if _HELD_INPUT in run.output("stderr"):
        return f"exit status {exited.returncode}; Python aborted", _NO_INPUT
    lost = exited.returncode == 0 and bool(run.last_words)  # it failed and said so, but not with its status
    said = f"exit status {exited.returncode}; the last line on stderr: {run.last_words or 'none'}"
    return said, _LOST_STATUS if lost else help


def has_number(line: str, number: float) -> bool:
    """Return whether a number, rounded to 0.01 or better, stands in a line that is not a whole table of them."""
    numbers = NUMBER.findall(line)
    return len(numbers) <= MANY_NUMBERS and any(abs(float(found) - number) <= 0.0101 for found in numbers)
