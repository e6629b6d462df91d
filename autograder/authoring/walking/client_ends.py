"""How a client of a walking action must end: when, with which exit status, and with which line of output."""

from __future__ import annotations

import math
import re

from action_msgs.msg import GoalStatus

from autograder.authoring.diagnosis.missing import Missing
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure, expect
from autograder.authoring.requirements.client_checks import has_number, require_end, why_not_this_status
from autograder.authoring.walking.client_run import (
    ABORTED,
    CANCELED,
    MIN_WAIT_TIME,
    ORDER_MARGIN,
    SUCCEEDED,
    ClientRun,
    End,
)

PRINT_TIME = 1.0  # s in which a line about the answer to a cancel is printed
BEYOND_ANY_SCENARIO = 100.0  # s; no scenario lasts so long
TRACEBACK = "Traceback (most recent call last)"
# By the final status of a goal (None: it has not ended): what became of it, in words, and a pattern for the line that
# must say so after Ctrl-C.
OUTCOME_PATTERNS = {
    GoalStatus.STATUS_SUCCEEDED: ("it SUCCEEDED all the same", r"succe|arriv|reached|\bstatus\W+4\b"),
    GoalStatus.STATUS_CANCELED: ("it was CANCELED", r"cancel|\bstatus\W+5\b"),
    GoalStatus.STATUS_ABORTED: ("it was ABORTED all the same", r"abort|\bstatus\W+6\b"),
    None: (
        "it has not ended yet",
        r"\b(not|never|still|yet|without|unknown|unfinished|goes on|going on|gave up|no (end|result))\b|n't",
    ),
}


def require_ending(client: ClientRun) -> tuple[list[End], ev.NodeExited]:
    """Require that it ended by itself, in time, with the exit status of an allowed end; return the ends with it."""
    run, ends = client.run, client.ends()
    exited = require_end(run, BEYOND_ANY_SCENARIO)
    if TRACEBACK in run.output("stderr"):
        if exited.t < min(end.earliest for end in ends):
            expected = "a client that follows the goal to its end"
            raise Missing(run, expected=expected, never=f"it had already ended at {exited.t:.1f} s")
        raise Failure(
            expected="one line that says how it ended",
            observed=f"a traceback: {run.last_words}",
            help="An expected end is not a crash: catch the exception, print one line, and return the status.",
            at=exited.t,
        )
    allowed = [end for end in ends if end.status == exited.returncode]
    require_patience(client, allowed or ends)
    if not allowed:
        observed, help = why_not_this_status(run, exited, ends[-1].help)
        expected = f"exit status {ends[-1].status}: {ends[-1].because}"
        raise Failure(expected=expected, observed=observed, help=help, at=exited.t)
    latest = max(end.latest for end in allowed)
    expect(
        exited.t <= latest,
        expected=f"the program to end by {latest:.1f} s: {allowed[-1].because}",
        observed=f"it ended at {exited.t:.1f} s",
        help=client.end_in_time,
        at=exited.t,
    )
    return allowed, exited


def require_patience(client: ClientRun, ends: list[End]) -> None:
    """Require that it did not end by itself before one of these ends was allowed."""
    exited = client.run.first(ev.NodeExited)
    if exited and exited.returncode >= 0 and exited.t < min(end.earliest for end in ends):
        raise client.left_early(ends[0], exited)


def require_its_line(client: ClientRun, allowed: list[End], exited: ev.NodeExited) -> None:
    """Require one line that says how it ended: with status 0 and 4 on stdout, else on stderr."""
    finished = client.goal.finished if client.goal else None
    if any(end.name == "Ctrl-C" for end in allowed):
        _require_outcome_line(client, exited)
    elif exited.returncode == SUCCEEDED and finished:
        _require_final_pose(finished, require_ending_line(client.run, "SUCCEEDED", exited.t), exited.t)
    elif exited.returncode == CANCELED and finished:
        require_ending_line(client.run, "CANCELED", exited.t, since=_said_of_the_end(client, finished))
    else:
        require_reason(client, allowed, exited)
    _require_no_other_ending(client, exited)


def printed(run: Transcript, stream: str, since: float = 0.0) -> list[ev.NodeOutput]:
    """Return the lines on a stream from a time (s) on that are not blank."""
    said = run.all(ev.NodeOutput)
    return [line for line in said if line.stream == stream and line.t >= since and line.text.strip()]


def require_ending_line(run: Transcript, word: str, at: float, since: float = 0.0) -> str:
    """Require exactly one line on stdout, from `since` (s) on, that contains this status word, and return it."""
    lines = [
        line.text
        for line in printed(run, "stdout", since)
        if re.search(rf"\b{word}\b", line.text, re.IGNORECASE)
    ]
    expect(
        len(lines) == 1,
        expected=f"one line on stdout with the word {word}",
        observed=f"{len(lines)}" + (": " + " | ".join(lines[:3]) if lines else ""),
        help=f"Call print({word!r}, …) once, when the result has come.",
        at=at,
    )
    return lines[0]


def _said_of_the_end(client: ClientRun, finished: ev.GoalFinished) -> float:
    """Return from when (s) on a line with CANCELED is about the goal's end: an earlier one may be about a request."""
    assert client.goal is not None
    if not client.asked:
        return 0.0
    agreed = [cancel.reply.t for cancel in client.goal.cancels if cancel.reply and cancel.reply.canceling]
    said = [event for event in client.run.all(ev.NodeOutput) if "CANCELED" in event.text.upper()]
    if said and any(t > finished.t - PRINT_TIME for t in agreed):
        return said[-1].t  # the answer to the request and the goal's end came together
    return finished.t - 0.1


def _require_no_other_ending(client: ClientRun, exited: ev.NodeExited) -> None:
    """Require that no line on stdout names another final status than the goal's, unless a cancel was requested."""
    other = {SUCCEEDED: "CANCELED", CANCELED: "SUCCEEDED"}.get(exited.returncode)
    if other is None or client.asked or client.interrupted < math.inf:
        return
    lines = [
        line for line in client.run.output("stdout").splitlines() if re.search(rf"\b{other}\b", line, re.I)
    ]
    expect(
        not lines,
        expected="no line on stdout that names another end",
        observed=f"“{lines[0]}”" if lines else "",
        help="Print how the goal ended after you have read response.status, and print only that status.",
        at=exited.t,
    )


def _require_final_pose(finished: ev.GoalFinished, line: str, at: float) -> None:
    position = finished.result.final_pose.pose.position
    for name, value in (("x", position.x), ("y", position.y)):
        expect(
            has_number(line, value),
            expected=f"the final {name}, {value:.2f} m, in the line that says how it ended",
            observed=f"“{line}”",
            help="Print response.result.final_pose.pose.position, where the robot is, not the position of your goal.",
            at=at,
        )


def require_reason(client: ClientRun, allowed: list[End], exited: ev.NodeExited) -> None:
    """Require a line on stderr that says why it ended, and exactly one with the server's reason after ABORTED."""
    run, since = client.run, min(end.earliest for end in allowed) - ORDER_MARGIN
    expect(
        bool(printed(run, "stderr", since)),
        expected="one line on stderr that says why it ended",
        observed=f"the last line on stderr: {run.last_words or 'none'}",
        help="Call print(..., file=sys.stderr) before the program ends.",
        at=exited.t,
    )
    finished = client.goal.finished if client.goal else None
    if exited.returncode != ABORTED or finished is None or not finished.result.error_msg:
        return
    reason = finished.result.error_msg
    expect(
        reason in run.output("stderr"),
        expected=f"the server's reason on stderr: {reason}",
        observed=f"“{run.last_words}”",
        help="Print response.result.error_msg with file=sys.stderr.",
        at=finished.t,
    )
    lines = [line for line in run.output().splitlines() if reason in line]
    expect(
        len(lines) == 1,
        expected="one line, on stderr, with the server's reason",
        observed=f"{len(lines)}: " + " | ".join(lines[:3]),
        help="Report the end once: print error_msg in one place, or log it, but not both.",
        at=finished.t,
    )


def _require_outcome_line(client: ClientRun, exited: ev.NodeExited) -> None:
    """Require a line on stdout that says what became of the goal after Ctrl-C: after its end, or the last line."""
    finished = client.goal.finished if client.goal else None
    status = finished.status if finished and client.result <= exited.t else None
    since = client.result - 0.1 if status else client.interrupted
    lines = printed(client.run, "stdout", client.interrupted - 0.1)
    said = [line.text for line in lines if line.t >= since or line is lines[-1]]
    is_late = status and client.result > client.interrupted + MIN_WAIT_TIME
    ways = [OUTCOME_PATTERNS[each][1] for each in ((status, None) if is_late else (status,))]
    expect(
        any(re.search(way, line, re.IGNORECASE) for way in ways for line in said),
        expected=f"a line on stdout at the end that says what became of the goal: {OUTCOME_PATTERNS[status][0]}",
        observed=f"the last line on stdout after Ctrl-C: {lines[-1].text if lines else 'none'}",
        help="Also after Ctrl-C, print a line with the goal's status when it has ended, or a line without one when you "
        "give up waiting.",
        at=exited.t,
    )
