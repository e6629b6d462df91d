"""What the servers did in a run, and how the program may therefore exit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.authoring import Request, Transcript, ev, started_at

ENABLE, STATUS = "enable_motors", "get_status"
TYPES = {ENABLE: "std_srvs/srv/SetBool", STATUS: "std_srvs/srv/Trigger"}
SCRIPTS = {ENABLE: "enable", STATUS: "status"}  # the inputs of a scenario with a service's script
WHOLE_DEADLINE = 10.0  # s for the whole program
ANSWER_TIMEOUT = 2.0  # s for a response, or for a server to appear
ANSWER_MARGIN = 0.4  # s; a response nearer than this to its timeout counts neither as in time nor as late
SURELY_FOUND = 1.7  # s after the node's start; a server that appears until then must be found
REFUSED = "enable_motors responded with success false"
SAME_REQUEST_TIME = 0.3  # s, within which two servers of one name receive the same request


@dataclass(frozen=True)
class Asked:
    """One request to a service, as each of its servers received it, and the replies."""

    requests: list[Request]

    @property
    def t(self) -> float:
        """When it came (s)."""
        return self.requests[0].received.t

    @property
    def replies(self) -> list[ev.ReplySent]:
        """The replies, in order."""
        return sorted((each.reply for each in self.requests if each.reply), key=lambda reply: reply.t)

    @property
    def is_answered(self) -> bool:
        """Whether a response certainly came in time."""
        return any(reply.t <= self.t + ANSWER_TIMEOUT - ANSWER_MARGIN for reply in self.replies)


@dataclass(frozen=True)
class Ends:
    """How a run may end: with success, with failure, or either."""

    may_succeed: bool  # with exit status 0
    may_fail: bool  # with exit status 1
    why: str  # the reason for a failure, in words
    messages: tuple[str, ...] = ()  # the messages of get_status, any of which may be printed


def asked(run: Transcript, service: str) -> list[Asked]:
    """Return the requests to a service; a request that two servers of one name receive counts once."""
    found: list[Asked] = []
    for request in run.requests(service):
        last = found[-1] if found else None
        servers = {each.received.server for each in last.requests} if last else set()
        if (
            last
            and request.received.t - last.t < SAME_REQUEST_TIME
            and request.received.server not in servers
        ):
            last.requests.append(request)
        else:
            found.append(Asked([request]))
    return found


def offered(run: Transcript, service: str) -> list[ev.ServiceOffered]:
    """Return the servers of a service that have the right type, in order."""
    return [
        each for each in run.all(ev.ServiceOffered) if (each.service, each.type) == (service, TYPES[service])
    ]


def died(run: Transcript, service: str, by: float) -> list[ev.ServiceWithdrawn]:
    """Return the servers of a service that had died by a time (s)."""
    return [each for each in run.all(ev.ServiceWithdrawn) if each.service == service and each.t <= by]


def is_gone(run: Transcript, service: str, t: float) -> bool:
    """Return whether the last server of a service had died by a time (s), and none came back until then."""
    gone = died(run, service, t)
    there = {each.server for each in run.all(ev.ServiceOffered) if each.service == service and each.t <= t}
    returns = (run.params.get(SCRIPTS[service]) or {}).get("returns")
    if gone and returns is not None and gone[-1].t + returns <= t:
        return False  # a client that waits finds it
    return bool(gone) and not there - {each.server for each in gone}


def is_missing(run: Transcript, service: str) -> bool | None:
    """Return whether a service counts as missing; None if that is uncertain."""
    servers = offered(run, service)
    if not servers:
        return True
    return False if servers[0].t - started_at(run) <= SURELY_FOUND else None


def expected_ends(run: Transcript) -> Ends:
    """Return how the run may end, why it fails, and the messages that may be printed."""
    missing = {service: is_missing(run, service) for service in (ENABLE, STATUS)}
    if all(missing.values()):
        return Ends(False, True, "there is no server of enable_motors or get_status")
    for service in missing:
        if missing[service]:
            types = [each for each in run.all(ev.ServiceOffered) if each.service == service]
            what = "has another type" if types else "has no server"
            return Ends(False, True, f"{service} {what}")
    late = [service for service in missing if missing[service] is None]
    may_fail, why = bool(late), f"{late[-1]} appeared late" if late else ""
    responses: list[Any] = []
    for service in missing:
        answers, responses = _answers(run, service)
        # without a request, it would have responded
        if False in answers and (asked(run, service) or may_fail):
            what = "died before it responded" if died(run, service, run.end) else "did not respond"
            may_fail, why = True, f"{service} {what}"
            if True not in answers:
                return Ends(False, True, why)
        if service == ENABLE and any(not response.success for response in responses):
            may_fail, why = True, REFUSED
            if not any(response.success for response in responses):
                return Ends(False, True, why)
    last = [reply.t for each in asked(run, STATUS) for reply in each.replies]
    may_fail |= bool(responses) and max(last) > started_at(run) + WHOLE_DEADLINE - ANSWER_MARGIN
    return Ends(True, may_fail, why, tuple(response.message for response in responses))


def _answers(run: Transcript, service: str) -> tuple[set[bool], list[Any]]:
    """Return whether the service responds (True) or not, both if that is uncertain, and the responses."""
    sent = asked(run, service)
    replies = [reply for each in sent for reply in each.replies]
    for each in sent:
        if each.is_answered:
            soon = each.replies[0].t + ANSWER_MARGIN
            return {True}, [reply.response for reply in replies if reply.t <= soon] or [replies[0].response]
    return {False} | ({True} if replies else set()), [reply.response for reply in replies]
