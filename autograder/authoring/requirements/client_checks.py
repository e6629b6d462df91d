"""Requirements on any client: that it ended in time, with which status, and what it printed."""

from __future__ import annotations

import re

from autograder.authoring.diagnosis.exit_diagnosis import remedy_for_a_traceback
from autograder.authoring.diagnosis.missing import Missing, unseen
from autograder.authoring.diagnosis.readiness import require_within_limits
from autograder.authoring.diagnosis.stack_location import where_it_waited
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Request
from autograder.authoring.evidence.scripted_goal import ScriptedGoal
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure, expect

SLACK = 2.0  # s on the arena's clock for start and shutdown: 0.4 s of real time at scale 5, on a busy machine
TIMED_OUT = 1  # the exit status of a client that has received nothing for too long
MAX_FEEDBACK_AGE = 4.0  # s; a goal whose last feedback is younger has not timed out
MAX_NUMBERS = 20  # in one line that is not a table
NUMBER = re.compile(r"[-+]?\d+(?:\.\d*)?")

_LOST_STATUS = (
    "It printed the reason but exited with status 0: return the status from main(), and end the file with "
    "sys.exit(main())."
)
_HELD_INPUT = "could not acquire lock for <_io.BufferedReader name='<stdin>'>"
_NO_INPUT = (
    "A daemon thread was still waiting in input() when the program ended, and Python aborts then: read with "
    "`for line in sys.stdin` instead."
)


def started_at(run: Transcript) -> float:
    """Return when the program's node appeared (s)."""
    started = run.first(ev.NodeReady) or run.first(ev.NodeStarted)
    if started is None:
        raise unseen(run, "the program was never started")
    return started.t


def require_end(run: Transcript, within: float) -> ev.NodeExited:
    """Require that the program ended by itself within `within` s after its node appeared."""
    require_within_limits(run)
    started, exited = started_at(run), run.first(ev.NodeExited)
    if exited is None:
        raise Failure(
            expected=f"the program to end by itself within {within:.3g} s",
            observed=f"it was still running after {run.end - started:.0f} s",
            help=_where_it_hung(run),
            at=run.end,
            see="03_clients_that_survive#kill-why",
        )
    expect(
        exited.t - started <= within + SLACK,
        expected=f"the program to end within {within:.3g} s",
        observed=f"it took {exited.t - started:.1f} s",
        help="Keep one deadline for the whole run, and give each wait only the time that is left until then.",
        at=exited.t,
    )
    return exited


def require_success(run: Transcript, within: float) -> None:
    """Require that the program ended with status 0, in time."""
    exited = require_end(run, within)
    remedy = remedy_for_a_traceback(run.output("stderr"))
    expect(
        exited.returncode == 0,
        expected="exit status 0",
        observed=how_it_ended(run, exited),
        help=remedy.help
        if remedy
        else "Return 0 from main() when the answers have arrived, and end the file with sys.exit(main()). An uncaught "
        "exception ends a program with status 1.",
        at=exited.t,
    )


def require_failure(run: Transcript, within: float, because: str) -> None:
    """Require that the program ended in time with status 1 and a message, not a traceback, on stderr."""
    exited = require_end(run, within)
    expect(
        exited.returncode == 1,
        expected=f"exit status 1: {because}",
        observed=how_it_ended(run, exited),
        help="Return the status from main() and end the file with sys.exit(main()): if main() returns nothing, the "
        "exit status is 0, which means success.",
        at=exited.t,
    )
    words = run.output("stderr")
    expect(
        "Traceback (most recent call last)" not in words,
        expected="one line on stderr that says what went wrong",
        observed=f"a traceback: {run.last_words}",
        help="An expected failure is not a crash: catch the exception, print one line with file=sys.stderr, and return "
        "the status.",
        at=exited.t,
    )
    expect(
        bool(words.strip()),
        expected="one line on stderr that says what went wrong",
        observed="nothing on stderr",
        help="Call print(..., file=sys.stderr) before the program ends: an exit status alone explains nothing.",
        at=exited.t,
    )


def require_requests(run: Transcript, service: str, number: int) -> list[Request]:
    """Require that the client sent exactly `number` requests to a service."""
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
    """Return the exit status and the last line on stderr, in words."""
    return f"exit status {exited.returncode}; the last line on stderr: {run.last_words or 'none'}"


def _where_it_hung(run: Transcript) -> str:
    """Return why the program did not end: before its first request, at an unanswered one, or after the last answer."""
    place = where_it_waited(run, in_main=True)
    blocked = f" It was blocked in {place}." if place else ""
    goals = [goal for event in run.all(ev.ActionOffered) for goal in run.scripted_goals(event.action)]
    return (_what_it_awaited_of_its_goal(goals[-1]) if goals else _at_which_request(run)) + blocked


def _at_which_request(run: Transcript) -> str:
    """Return at which request, or after which answer, a client of services hung."""
    requests = {event.service: run.requests(event.service) for event in run.all(ev.ServiceOffered)}
    sent = sorted((each for of in requests.values() for each in of), key=lambda each: each.received.t)
    if not sent:
        wait = "wait_for_server" if run.first(ev.ActionOffered) else "wait_for_service or wait_for_server"
        return f"It hung before it sent anything: {wait} has no timeout_sec, or its loop never ends."
    last = sent[-1]
    service = last.received.service
    number = len(requests[service])
    if last.reply is None:
        after = f"It hung after request {number} (to {service}) was sent"
        if number > 2:
            return (
                f"It sent {number} requests to {service} and never stopped: a loop `for _ in range(2)` ends."
            )
        if any(gone.server == last.received.server for gone in run.all(ev.ServiceWithdrawn)):
            return f"{after}, and the server died: it may never come back, so give each wait a timeout."
        return (
            f"{after} and not answered: give spin_until_future_complete a timeout_sec, and look at future.done() "
            "afterwards."
        )
    if unasked := [service for service, of in requests.items() if not of]:
        return (
            f"It hung after {service} had answered, and never called {unasked[0]}: give wait_for_service a "
            "timeout_sec, and spin the node while you wait for a future. Do not wait in a callback: the node cannot "
            "spin meanwhile."
        )
    return (
        f"It kept running after the last answer, at {last.reply.t:.1f} s: do not spin after it, end all your threads, "
        "and give each wait for another server a timeout."
    )


def _what_it_awaited_of_its_goal(goal: ScriptedGoal) -> str:
    """Return what a client that hung was waiting for, by the state of its goal."""
    if goal.reply is None:
        return "It hung waiting for the answer to its goal: give that wait a timeout."
    if not goal.is_accepted:
        return f"It kept running after its goal was rejected, at {goal.reply.t:.1f} s: a rejected goal has no result."
    if goal.result_sent:
        return f"It kept running after the result came, at {goal.result_sent.t:.1f} s: end every loop and thread."
    if goal.finished and goal.result_requested is None:
        return "It never requested the result, so none came: call goal_handle.get_result_async()."
    if goal.cancels and goal.cancels[0].reply is None:
        return "It hung waiting for the answer to its cancel request: give that wait a timeout, too."
    if goal.cancels:
        return "It hung because the cancelled goal did not end: after a cancel, give the wait for the result a timeout."
    return "It hung because its goal did not end: give up when no feedback has come for too long."


# -- clients of an action ---------------------------------------------------------------------------------------------


def require_one_goal(run: Transcript, action: str) -> ScriptedGoal:
    """Require that the client sent exactly one goal, and return it."""
    if not any(event.action == action for event in run.all(ev.ActionOffered)):
        raise unseen(run, f"{action} was not offered")
    goals = run.scripted_goals(action)
    if not goals:
        raise Missing(run, expected=f"a goal for {action}", never="no goal was ever sent")
    expect(
        len(goals) == 1,
        expected=f"one goal for {action}",
        observed=f"{len(goals)}",
        help="Send the goal once, and wait for its result: a second goal would compete with it for the robot.",
        at=goals[-1].received.t,
    )
    return goals[0]


def why_it_left(goal: ScriptedGoal, exited: ev.NodeExited) -> str:
    """Return what to do about a client that ended before its goal, by the last message it received."""
    times = [feedback.t for feedback in goal.feedback if feedback.t < exited.t]
    if exited.returncode == TIMED_OUT and times and exited.t - times[-1] < MAX_FEEDBACK_AGE:
        return (
            f"It gave up, although feedback came until {times[-1]:.1f} s: a goal may take long. Only the time since "
            "the last feedback is limited."
        )
    reply = goal.cancels[0].reply if goal.cancels else None
    if reply and not reply.canceling:
        return (
            "The cancel was refused: goals_canceling is empty. So the goal goes on: wait for its result before you "
            "return."
        )
    if reply:
        return "The answer to a cancel says only that the server will try: wait for the result before you return."
    if goal.cancels:
        return "Sending a cancel request does not end the goal: wait for the result before you return."
    if goal.result_requested is None:
        return "It never requested the result: call goal_handle.get_result_async(), and wait for its future."
    return "After the acceptance, wait for the future of get_result_async() before you return."


def how_to_give_up(run: Transcript) -> str:
    """Return what to do about a client that did not cancel a goal whose feedback had stopped."""
    cancel = "call goal_handle.cancel_goal_async(), and spin until it is sent"
    if run.first(ev.NodeExited):
        return f"It ended while the robot still walks: before you give up on an accepted goal, {cancel}."
    return (
        "It was still waiting for the result when the scenario ended: store the time of the last feedback, and 5 s "
        f"after it {cancel}."
    )


def why_not_this_status(run: Transcript, exited: ev.NodeExited, help: str) -> tuple[str, str]:
    """Return how a program with a wrong exit status ended, and what to do: `help` unless the output shows a cause."""
    if _HELD_INPUT in run.output("stderr"):
        return f"exit status {exited.returncode}; Python aborted", _NO_INPUT
    # it printed a failure, but its status says success
    lost = exited.returncode == 0 and bool(run.last_words)
    return how_it_ended(run, exited), _LOST_STATUS if lost else help


def has_number(line: str, number: float) -> bool:
    """Return whether a line, unless it is a table, contains this number, rounded to 0.01 or better."""
    numbers = NUMBER.findall(line)
    return len(numbers) <= MAX_NUMBERS and any(abs(float(found) - number) <= 0.0101 for found in numbers)


def _about_the_number(observed: int, expected: int, service: str) -> str:
    """Return what to do about too many requests, or too few."""
    if observed == 0:
        return (
            f"Your program never called {service}: compare its name and type, and wait until it is available."
        )
    if observed > expected:
        allowed = "only one retry is allowed" if expected == 2 else f"only {expected} may be sent"
        return f"It sent {observed} request{'s' if observed != 1 else ''}: {allowed}."
    if observed == 1:
        return "It gave up after one request: retry once."
    return f"It gave up after {observed} requests."
