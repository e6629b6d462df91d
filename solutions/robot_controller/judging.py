"""Judges a run of the robot controller."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.authoring.call import Request
from autograder.authoring.client_checks import (
    require_end,
    require_offered,
    require_reply,
    require_requests,
    require_success,
)
from autograder.authoring.failure import expect
from autograder.authoring.missing import Missing, unseen
from autograder.authoring.transcript import Transcript

ENABLE, STATUS = "enable_motors", "get_status"
WITHIN = 10.0  # s for everything
NO_SERVER = (1,)
PREFIX = "Robot status: "


def require_enabled_before_asked(run: Transcript) -> None:
    """Require that the motors were enabled, and get_status was asked after the answer."""
    for service in (ENABLE, STATUS):
        require_offered(run, service)
    requests = run.requests(ENABLE)
    if not requests:
        require_end(run, WITHIN)
    expect(
        bool(requests),
        expected="a request to enable_motors",
        observed=f"none; the last line on stderr: {run.last_words or 'none'}",
        help="Create the client with the relative name 'enable_motors' and type std_srvs/srv/SetBool, wait until the "
        "service is there, and send the request.",
        at=run.end,
    )
    first = requests[0]
    expect(
        first.message.data,
        expected="data: true, which switches the motors on",
        observed="data: false",
        help="A new request holds false: set request.data = True before you send it.",
        at=first.received.t,
    )
    asked = run.requests(STATUS)
    expect(
        bool(asked),
        expected="a request to get_status after enable_motors was answered",
        observed="none",
        help="The answer arrived, but the node did not take it: spin the node while you wait for a future, and do not "
        "wait in a callback, which keeps the node from spinning.",
        at=run.end,
    )
    reply = require_reply(run, ENABLE)
    expect(
        asked[0].received.t >= reply.t,
        expected="get_status to be asked after enable_motors was answered",
        observed=f"{reply.t - asked[0].received.t:.3f} s before",
        help="call_async returns at once: wait for the first future before you send the second request, or the "
        "status is that of a robot whose motors are still off.",
        at=asked[0].received.t,
    )


def require_printed_status(run: Transcript, messages: Sequence[str]) -> None:
    """Require success, answers of both services, and one printed status with one of the messages."""
    require_success(run, WITHIN)
    printed = [
        line.rstrip() for line in run.output("stdout").splitlines() if line.startswith(PREFIX.rstrip())
    ]
    expect(
        len(printed) == 1,
        expected=f"one line on stdout that begins with “{PREFIX.rstrip()}”",
        observed=f"{len(printed)} of them" + (": " + " | ".join(printed[:3]) if printed else ""),
        help="print(f'Robot status: {response.message}') once, when the answer you waited for has come. A logger "
        "writes to stderr; a callback left on a request you gave up on prints as well, so remove that request.",
        at=run.end,
    )
    expect(
        printed[0] in [PREFIX + message for message in messages],
        expected=" or ".join(f"“{PREFIX}{message}”" for message in messages),
        observed=f"“{printed[0]}”",
        help="Print the message of the response to get_status, as it came.",
        at=run.end,
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


def require_silence(run: Transcript, service: str, number: int) -> list[Request]:
    """Require that the client sent so many requests to a service that answered none of them."""
    require_offered(run, service)
    requests = require_requests(run, service, number)
    if any(request.reply for request in requests):
        raise unseen(run, f"{service} answered though it should not")
    return requests


def require_pause(run: Transcript, after: float) -> None:
    """Require that both services took their time (s) for the answer."""
    for service in (ENABLE, STATUS):
        reply = require_reply(run, service)
        asked = next(request.received.t for request in run.requests(service) if request.reply == reply)
        if reply.t - asked < 0.9 * after:
            raise unseen(run, f"{service} answered too early")
