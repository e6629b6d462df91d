"""Requirements on any client: that it ended in time, with which status, and what it printed."""

from __future__ import annotations

import re

from autograder.authoring.diagnosis.missing import Missing, unseen
from autograder.authoring.diagnosis.readiness import require_within_limits
from autograder.authoring.diagnosis.stack_location import where_it_waited
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Request
from autograder.authoring.evidence.scripted_goal import ScriptedGoal
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure, expect

SLACK = 2.0  # s on the arena's clock for start and shutdown: 0.4 s of real time at scale 5, on a busy machine
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


def started_at(run: Transcript) -> float:
    """Return when the program's node appeared (s)."""
    started = run.first(ev.NodeReady) or run.first(ev.NodeStarted)
    if started is None:
        raise unseen(run, "the program was never started")
    return started.t


def require_end(run: Transcript, within: float) -> ev.NodeExited:
    """Require that the program ended by itself within so many seconds of its node's appearance."""
    require_within_limits(run)
    started, exited = started_at(run), run.first(ev.NodeExited)
    if exited is None:
        raise Failure(
            expected=f"the program to end by itself within {within:.3g} s",
            observed=f"it still ran after {run.end - started:.0f} s",
            help=_where_it_hung(run),
            at=run.end,
            see="03_clients_that_survive#kill-why",
        )
    expect(
        exited.t - started <= within + SLACK,
        expected=f"the program to end within {within:.3g} s",
        observed=f"it took {exited.t - started:.1f} s",
        help="Keep one deadline for the whole run, and wait for nothing longer than what is left until then.",
        at=exited.t,
    )
    return exited


def require_success(run: Transcript, within: float) -> None:
    """Require that the program ended with status 0, in time."""
    exited = require_end(run, within)
    expect(
        exited.returncode == 0,
        expected="exit status 0",
        observed=how_it_ended(run, exited),
        help="Return 0 from main() when the answers have come, and end the file with sys.exit(main()). An exception "
        "nobody catches ends a program with status 1.",
        at=exited.t,
    )


def require_failure(run: Transcript, within: float, because: str) -> None:
    """Require that the program ended in time with status 1 and a message, not a traceback, on stderr."""
    exited = require_end(run, within)
    expect(
        exited.returncode == 1,
        expected=f"exit status 1: {because}",
        observed=how_it_ended(run, exited),
        help="Return the status from main() and end the file with sys.exit(main()): a main() that returns nothing "
        "ends with 0, which says that all went well.",
        at=exited.t,
    )
    words = run.output("stderr")
    expect(
        "Traceback (most recent call last)" not in words,
        expected="one line on stderr that says what went wrong",
        observed=f"a traceback: {run.last_words}",
        help="An expected failure is no crash: catch it, print one line with file=sys.stderr, return the status.",
        at=exited.t,
    )
    expect(
        bool(words.strip()),
        expected="one line on stderr that says what went wrong",
        observed="nothing on stderr",
        help="print(..., file=sys.stderr) before the program ends: a status alone tells people nothing.",
        at=exited.t,
    )


def require_requests(run: Transcript, service: str, number: int) -> list[Request]:
    """Require that the client sent exactly so many requests to a service."""
    requests = run.requests(service)
    expect(
        len(requests) == number,
        expected=f"{number} request{'s' if number != 1 else ''} to {service}",
        observed=f"{len(requests)}",
        help=_about_the_number(len(requests), number, service),
        at=requests[-1].received.t if requests else run.end,
    )
    return requests


def how_it_ended(run: Transcript, exited: ev.NodeExited) -> str:
    """Return its exit status and its last words, as they were observed."""
    return f"exit status {exited.returncode}; the last line on stderr: {run.last_words or 'none'}"


def _where_it_hung(run: Transcript) -> str:
    """Return why the program did not end: before its first request, at an unanswered one, or after the last answer."""
    place = where_it_waited(run, in_main=True)
    stood = f" It stood in {place}." if place else ""
    goals = [goal for event in run.all(ev.ActionOffered) for goal in run.scripted_goals(event.action)]
    return (_where_its_goal_stood(goals[-1]) if goals else _at_which_request(run)) + stood


def _at_which_request(run: Transcript) -> str:
    """Return for what a client of services still waits."""
    requests = {event.service: run.requests(event.service) for event in run.all(ev.ServiceOffered)}
    sent = sorted((each for of in requests.values() for each in of), key=lambda each: each.received.t)
    if not sent:
        wait = "wait_for_server" if run.first(ev.ActionOffered) else "wait_for_service or wait_for_server"
        return f"It hung before it sent anything: {wait} has no timeout_sec, or its loop has no end."
    last = sent[-1]
    service = last.received.service
    number = len(requests[service])
    if last.reply is None:
        after = f"It hung after request {number} (to {service}) was sent"
        if number > 2:
            return f"It sent {number} requests to {service} and went on asking: a loop `for _ in range(2)` would end."
        if any(gone.server == last.received.server for gone in run.all(ev.ServiceWithdrawn)):
            return f"{after}, when the server had died: it may never come back, so give each wait a limit."
        return (
            f"{after} and not answered: give spin_until_future_complete a timeout_sec, and look at future.done() "
            "afterwards."
        )
    if unasked := [service for service, of in requests.items() if not of]:
        return (
            f"It hung after {service} had answered, and never asked {unasked[0]}: give wait_for_service a timeout_sec, "
            "and spin the node while you wait for a future, not in a callback, which keeps the node from spinning."
        )
    return (
        f"It went on after the last answer, at {last.reply.t:.1f} s: do not spin after it, end every thread of your "
        "own, and give a wait for another server a limit."
    )


def _where_its_goal_stood(goal: ScriptedGoal) -> str:
    """Return for what a client still waits, by how far its goal has come."""
    if goal.reply is None:
        return "It hung while its goal was not answered: give the wait for the answer a time limit."
    if not goal.is_accepted:
        return (
            f"It went on after its goal was rejected, at {goal.reply.t:.1f} s: a rejected goal has no result."
        )
    if goal.result_sent:
        return f"It went on after the result came, at {goal.result_sent.t:.1f} s: end every loop and thread."
    if goal.finished and goal.result_requested is None:
        return "It never asked for the result, so none came: call goal_handle.get_result_async()."
    if goal.cancels and goal.cancels[0].reply is None:
        return "It hung while its request to cancel was not answered: give that wait a time limit, too."
    if goal.cancels:
        return "It hung while the cancelled goal did not end: give the wait for the result a time limit after a cancel."
    return "It hung while its goal did not end: give up when nothing has been heard of it for too long."


# -- clients of an action ---------------------------------------------------------------------------------------------


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
    return how_it_ended(run, exited), _LOST_STATUS if lost else help


def has_number(line: str, number: float) -> bool:
    """Return whether a number, rounded to 0.01 or better, stands in a line that is not a whole table of them."""
    numbers = NUMBER.findall(line)
    return len(numbers) <= MANY_NUMBERS and any(abs(float(found) - number) <= 0.0101 for found in numbers)


def _about_the_number(observed: int, expected: int, service: str) -> str:
    """Return what to do about too many requests, or too few."""
    if observed == 0:
        return f"Your program never asked {service}: compare its name and type, and wait until it is found."
    if observed > expected:
        few = "one retry is allowed" if expected == 2 else f"{expected} would do"
        return f"{observed} request{'s' if observed != 1 else ''}: {few}."
    if observed == 1:
        return "Only one request, then it gave up. Where is the second try?"
    return f"Only {observed} requests, then it gave up."
