"""Requirements on any client: that it ended in time, with which status, and what it printed."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.call import Request
from autograder.authoring.checks import Failure, expect
from autograder.authoring.missing import unseen
from autograder.authoring.readiness import require_within_limits
from autograder.authoring.scripted_goal import ScriptedGoal
from autograder.authoring.standing import where_it_stood
from autograder.authoring.transcript import Transcript

SLACK = 2.0  # s on the arena's clock for start and shutdown: 0.4 s of real time at scale 5, on a busy machine


def require_end(run: Transcript, within: float) -> ev.NodeExited:
    """Require that the program ended by itself within so many seconds of its node's appearance."""
    require_within_limits(run)
    started = run.first(ev.NodeReady) or run.first(ev.NodeStarted)
    if started is None:
        raise unseen(run, "the program was never started")
    exited = run.first(ev.NodeExited)
    if exited is None:
        raise Failure(
            expected=f"the program to end by itself within {within:.3g} s",
            observed=f"it still ran after {run.end - started.t:.0f} s",
            help=_where_it_hung(run),
            at=run.end,
            see="03_clients_that_survive#kill-why",
        )
    expect(
        exited.t - started.t <= within + SLACK,
        expected=f"the program to end within {within:.3g} s",
        observed=f"it took {exited.t - started.t:.1f} s",
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
        observed=_ending(run, exited),
        help="Return 0 from main() when the answers have come, and end the file with sys.exit(main()). An exception "
        "nobody catches ends a program with status 1.",
        at=exited.t,
    )


def require_failure(run: Transcript, within: float, statuses: tuple[int, ...], because: str) -> None:
    """Require that the program ended in time with one of the statuses and a message, not a traceback, on stderr."""
    exited = require_end(run, within)
    wanted = " or ".join(map(str, statuses))
    expect(
        exited.returncode in statuses,
        expected=f"exit status {wanted}: {because}",
        observed=_ending(run, exited),
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


def _ending(run: Transcript, exited: ev.NodeExited) -> str:
    return f"exit status {exited.returncode}; the last line on stderr: {run.last_words or 'none'}"


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


def _where_it_hung(run: Transcript) -> str:
    """Return why the program did not end: before its first request, at an unanswered one, or after the last answer."""
    services = dict.fromkeys(event.service for event in run.all(ev.ServiceOffered))
    requests = [request for service in services for request in run.requests(service)]
    requests.sort(key=lambda request: request.received.t)
    place = where_it_stood(run, in_main=True)
    stood = f" It stood in {place}." if place else ""
    goals = [goal for event in run.all(ev.ActionOffered) for goal in run.scripted_goals(event.action)]
    if goals:
        return _where_its_goal_stood(goals[-1]) + stood
    if not requests:
        wait = "wait_for_server" if run.first(ev.ActionOffered) else "wait_for_service or wait_for_server"
        return f"It hung before it sent anything: {wait} has no timeout_sec, or its loop has no end.{stood}"
    last = requests[-1]
    if last.reply is None:
        return (
            f"It hung after request {len(requests)} (to {last.received.service}) was sent and not answered: give "
            f"spin_until_future_complete a timeout_sec, and look at future.done() afterwards.{stood}"
        )
    return (
        f"It went on after the last answer, at {last.reply.t:.1f} s: do not spin after it, and end every thread of "
        f"your own.{stood}"
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
