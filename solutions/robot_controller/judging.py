"""Judges a run of the robot controller."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.authoring import client_checks
from autograder.authoring import events as ev
from autograder.authoring.call import Request
from autograder.authoring.client_checks import require_offered, require_reply
from autograder.authoring.failure import Failure, expect
from autograder.authoring.missing import Missing, unseen
from autograder.authoring.readiness import require_within_limits
from autograder.authoring.transcript import Transcript

from .advice import ENABLE, SOONEST, STATUS, Advice, why_it_failed, why_it_hung, why_not_one

WITHIN = 10.0  # s for everything
DEADLINE_SLACK = 0.8  # s for the line that says so; ending takes longer, for which `client_checks` allows
GAVE_UP = (1,)  # the exit status where a server is missing, refuses or is silent
LATEST = 3.5  # s between a request and its repetition; 2 s are asked for
PREFIX = "Robot status: "
PRINTING = "03_clients_that_survive#fix-file"  # the lesson


# -- how it ended -----------------------------------------------------------------------------------------------------


def require_end(run: Transcript) -> ev.NodeExited:
    """Require that the program ended by itself, in time; if it hung, say where."""
    require_within_limits(run)
    if run.first(ev.NodeExited) is None and run.first(ev.NodeStarted) is not None:
        raise _failure(f"the program to end by itself within {WITHIN:g} s", why_it_hung(run), run.end)
    return client_checks.require_end(run, WITHIN)


def require_success(run: Transcript) -> None:
    """Require that the program ended with status 0, in time."""
    exited = require_end(run)
    if exited.returncode != 0:
        raise _failure(
            "exit status 0, because both services were there", why_it_failed(run, exited), exited.t
        )


def require_failure(run: Transcript, because: str) -> ev.NodeExited:
    """Require that the program gave up in time: exit status 1, and a message, not a traceback, on stderr."""
    exited = require_end(run)
    if exited.returncode not in GAVE_UP:
        raise _failure(f"exit status 1: {because}", why_not_one(run, exited), exited.t)
    client_checks.require_failure(run, WITHIN, GAVE_UP, because)
    return exited


def require_one_deadline(run: Transcript) -> None:
    """Require that the program said within the 10 s that it gave up, however late the servers were."""
    started = run.first(ev.NodeReady) or run.first(ev.NodeStarted)
    lines = [line.t for line in run.all(ev.NodeOutput) if line.stream == "stderr"]
    if started is None or not lines:
        raise unseen(run, "nobody saw when the program gave up")
    took = lines[-1] - started.t
    asked = " and ".join(f"{request.received.t - started.t:.1f} s" for request in run.requests(STATUS))
    expect(
        took <= WITHIN + DEADLINE_SLACK,
        expected=f"it to give up within {WITHIN:g} s in all, however late the servers are",
        observed=f"it gave up after {took:.1f} s; get_status was asked at {asked or 'no time'}",
        help="Set one deadline at the start, time.monotonic() + 10.0, and give each wait at most what is left of it.",
        at=lines[-1],
    )


# -- what it asked ----------------------------------------------------------------------------------------------------


def require_enabled_before_asked(run: Transcript) -> None:
    """Require that the motors were enabled, and get_status was asked after the answer."""
    for service in (ENABLE, STATUS):
        require_offered(run, service)
    first = _first_request(run, ENABLE)
    expect(
        first.message.data,
        expected="data: true, which switches the motors on",
        observed="data: false",
        help="A new request holds false: set request.data = True before you send it.",
        at=first.received.t,
    )
    asked = _first_request(run, STATUS)
    reply = require_reply(run, ENABLE)
    expect(
        asked.received.t >= reply.t,
        expected="get_status to be asked after enable_motors was answered",
        observed=f"{reply.t - asked.received.t:.3f} s before",
        help="call_async returns at once: wait for the first future before you send the second request, or the "
        "status is that of a robot whose motors are still off.",
        at=asked.received.t,
    )


def require_asked_here(run: Transcript, namespace: str) -> None:
    """Require that enable_motors was asked in the namespace in which the program was started."""
    require_end(run)
    expect(
        bool(run.requests(ENABLE)),
        expected=f"a request to {namespace}/{ENABLE}",
        observed=f"none there; the last line on stderr: {run.last_words or 'none'}",
        help=f"Use relative names, “{ENABLE}” without a slash in front: the namespace belongs to whoever starts the "
        "node.",
        at=run.end,
    )


def require_silence(run: Transcript, service: str) -> tuple[Request, Request]:
    """Require that the client sent exactly two requests to a service that answered none of them."""
    require_offered(run, service)
    requests = run.requests(service)
    if any(request.reply for request in requests):
        raise unseen(run, f"{service} answered though it should not")
    if len(requests) < 2:
        require_end(run)
    expected = f"2 requests to {service}: one, and one more when no answer has come within 2 s"
    if not requests:
        raise Missing(run, expected=expected, never=f"{service} was never asked")
    at = requests[-1].received.t
    expect(
        len(requests) >= 2,
        expected=expected,
        observed="Only one request, then it gave up.",
        help="Where is the second try? Remove the request that was not answered, and send another.",
        at=at,
    )
    expect(
        len(requests) <= 2,
        expected=expected,
        observed=f"{len(requests)} requests",
        help="One retry is allowed: give up when the second request is not answered either.",
        at=at,
    )
    return requests[0], requests[1]


def require_pause_of_two_seconds(first: Request, second: Request) -> None:
    """Require that the second request came about 2 s after the first."""
    pause = second.received.t - first.received.t
    expect(
        SOONEST <= pause <= LATEST,
        expected="the second request 2 s after the first",
        observed=f"{pause:.1f} s after it",
        help="You stop waiting too early: an answer may take 2 s. Wait with timeout_sec=2.0."
        if pause < SOONEST
        else "You wait too long before you ask again: give the first wait timeout_sec=2.0.",
        at=second.received.t,
    )


def require_slow_answers(run: Transcript, after: float) -> None:
    """Require that both services took their time (s) for the answer."""
    for service in (ENABLE, STATUS):
        reply = require_reply(run, service)
        asked = next(request.received.t for request in run.requests(service) if request.reply == reply)
        if reply.t - asked < 0.9 * after:
            raise unseen(run, f"{service} answered too early")


def require_late_servers(run: Transcript, after: float) -> None:
    """Require that both services appeared so many seconds late, and that get_status never answered."""
    started = run.first(ev.NodeReady) or run.first(ev.NodeStarted)
    for service in (ENABLE, STATUS):
        require_offered(run, service)
        offered = run.one(ev.ServiceOffered, "service", service)
        if started is None or offered is None or offered.t - started.t < 0.9 * after:
            raise unseen(run, f"{service} was there too early")
    if any(request.reply for request in run.requests(STATUS)):
        raise unseen(run, f"{STATUS} answered though it should not")


def _first_request(run: Transcript, service: str) -> Request:
    """Return the first request to a service that is there; if there was none, say why."""
    requests = run.requests(service)
    if requests:
        return requests[0]
    expected = f"a request to {service}" + (" after enable_motors was answered" if service == STATUS else "")
    exited = require_end(run)
    raise _failure(expected, why_it_failed(run, exited), exited.t)


# -- what it printed --------------------------------------------------------------------------------------------------


def require_printed_status(run: Transcript, messages: Sequence[str]) -> None:
    """Require success, answers of both services, and one printed status with one of the messages."""
    require_success(run)
    printed = [
        line.rstrip() for line in run.output("stdout").splitlines() if line.startswith(PREFIX.rstrip())
    ]
    expect(
        len(printed) == 1,
        expected=f"one line on stdout that begins with “{PREFIX.rstrip()}”",
        observed=f"{len(printed)} of them" + (": " + " | ".join(printed[:3]) if printed else ""),
        help=_how_to_print_one(run, len(printed)),
        at=run.end,
        see=PRINTING,
    )
    expect(
        printed[0] in [PREFIX + message for message in messages],
        expected=" or ".join(f"“{PREFIX}{message}”" for message in messages),
        observed=f"“{printed[0]}”",
        help="Print the message of the response to get_status, all of it: print(f'Robot status: {response.message}').",
        at=run.end,
        see=PRINTING,
    )
    require_reply(run, ENABLE)
    require_reply(run, STATUS)


def require_printed_second_answer(run: Transcript) -> None:
    """Require that each service answered only the second request, and that the status was printed."""
    require_printed_status(run, [run.params["status"]])
    for service in (ENABLE, STATUS):
        first, *others = run.requests(service)
        if first.reply is not None:
            raise unseen(run, f"{service} answered the first request")
        if not any(request.reply for request in others):
            raise Missing(
                run,
                expected=f"{service} to be asked once more when no answer has come in time",
                never="it was asked only once",
            )


def _how_to_print_one(run: Transcript, lines: int) -> str:
    if lines > 1 and lines <= sum(request.reply is not None for request in run.requests(STATUS)):
        return "A callback left on a request you gave up on prints as well: remove that request."
    if lines:
        return "Print once: when get_status has answered, and nothing before."
    if PREFIX.rstrip() in run.output("stderr"):
        return "It stands on stderr, where a logger writes: use print(f'Robot status: {response.message}')."
    return "print(f'Robot status: {response.message}') when get_status has answered."


def _failure(expected: str, advice: Advice, at: float) -> Failure:
    return Failure(expected=expected, observed=advice.observed, help=advice.help, at=at)
