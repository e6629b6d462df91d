"""Requirements on a client of a scripted action: what it sent, when it gave up, whom it cancelled, what it printed."""

from __future__ import annotations

import re
from collections.abc import Sequence

from autograder.authoring import events as ev
from autograder.authoring.client_checks import SLACK, require_end
from autograder.authoring.failure import Failure, expect
from autograder.authoring.missing import Missing, unseen
from autograder.authoring.scripted_goal import ScriptedCancel, ScriptedGoal
from autograder.authoring.transcript import Transcript

NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?")


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
    if goal.finished is None or goal.finished.status != status:
        gone = exited.t if exited else run.end
        raise Missing(
            run,
            expected="a client that follows the goal to its end",
            never=f"at {gone:.1f} s it was gone already",
        )
    if exited and exited.t < goal.finished.t:
        raise Failure(
            expected="a client that follows the goal to its end",
            observed=f"it ended {goal.finished.t - exited.t:.1f} s before the goal did",
            help="After the acceptance, wait for the future of get_result_async() before you return.",
            at=exited.t,
        )
    return goal.finished


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


def require_no_cancel(goal: ScriptedGoal, *, because: str) -> None:
    """Require that the client cancelled nothing."""
    if goal.cancels:
        raise Failure(
            expected=f"no request to cancel: {because}",
            observed=f"one came {goal.cancels[0].received.t - goal.received.t:.1f} s after the goal",
            help="Cancel only when you are asked to, or when nothing has been heard for too long.",
            at=goal.cancels[0].received.t,
        )


def require_exit(
    run: Transcript, within: float, status: int, *, because: str, stream: str, help: str
) -> ev.NodeExited:
    """Require that the program ended in time with a status and a line on a stream, and printed no traceback."""
    exited = require_end(run, within)
    expect(
        exited.returncode == status,
        expected=f"exit status {status}: {because}",
        observed=f"exit status {exited.returncode}; the last line on stderr: {run.last_words or 'none'}",
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


def require_numbers(
    lines: Sequence[str], wanted: Sequence[float], *, what: str, help: str, at: float
) -> None:
    """Require that the numbers stand in the lines, in this order, each in a line of its own, rounded to 0.01."""
    rest = iter(lines)
    for number in wanted:
        if not any(has_number(line, number) for line in rest):
            raise Failure(
                expected=f"{what}: a line with {number:.2f}",
                observed=" | ".join(lines[:6]) or "nothing on stdout",
                help=help,
                at=at,
            )


def has_number(line: str, number: float) -> bool:
    """Return whether a number, rounded to 0.01 or better, stands in a line."""
    return any(abs(float(found) - number) <= 0.0101 for found in NUMBER.findall(line))


def heard_last(run: Transcript, goal: ScriptedGoal) -> float:
    """Return when (s) the client last heard of the goal: its answer, or feedback."""
    heard = [goal.received.t, *(feedback.t for feedback in goal.feedback)]
    return max([*heard, goal.reply.t] if goal.reply else heard)


def require_patience(run: Transcript, since: float, until: float, patience: float, *, what: str) -> None:
    """Require that the client waited so long (s) in silence, not much shorter and not much longer."""
    waited = until - since
    expect(
        patience - 0.5 <= waited <= patience + SLACK,
        expected=f"{what} {patience:g} s after it last heard of the server",
        observed=f"{waited:.1f} s after it",
        help=f"Note the time of the acceptance and of each feedback, and give up when the last is {patience:g} s old.",
        at=until,
    )
