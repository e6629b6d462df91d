"""What must hold of every run of the robot controller, whatever its servers do: what is asked, printed and answered."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from autograder.authoring import client_checks
from autograder.authoring import events as ev
from autograder.authoring.call import Request
from autograder.authoring.failure import Failure, expect
from autograder.authoring.missing import unseen
from autograder.authoring.obligation import obligation, whole_run
from autograder.authoring.readiness import require_within_limits
from autograder.authoring.transcript import Transcript

from .advice import (
    ENABLE,
    SOONEST,
    STATUS,
    TYPES,
    Advice,
    gave_up_at,
    how_to_print_one,
    why_it_failed,
    why_it_hung,
    why_not_one,
)

WITHIN = 10.0  # s for everything
DEADLINE_SLACK = 0.8  # s for the line that says so; ending takes longer, for which `client_checks` allows
PATIENCE = 2.0  # s for an answer
MARGIN = 0.4  # s by which an answer has to be early, or late, to count as such
LATEST = 3.5  # s between a request and its repetition; 2 s are asked for
SURELY_FOUND = 1.7  # s after the node in which a server has appeared in time
SAME = 0.3  # s within which two servers of one name get one request
PREFIX = "Robot status: "
SCRIPTS = {ENABLE: "enable", STATUS: "status"}  # the inputs of a scenario that say what a service does
PRINTING = "03_clients_that_survive#fix-file"  # the lesson


@dataclass(frozen=True)
class Asked:
    """One request to a service, as each of its servers got it, and the replies."""

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
        """Whether an answer certainly came in time."""
        return any(reply.t <= self.t + PATIENCE - MARGIN for reply in self.replies)


# -- what the servers did ---------------------------------------------------------------------------------------------


def started_at(run: Transcript) -> float:
    """Return when the program's node appeared (s)."""
    started = run.first(ev.NodeReady) or run.first(ev.NodeStarted)
    if started is None:
        raise unseen(run, "the program was never started")
    return started.t


def asked(run: Transcript, service: str) -> list[Asked]:
    """Return the requests to a service; what reaches two servers of one name at once is one."""
    found: list[Asked] = []
    for request in run.requests(service):
        last = found[-1] if found else None
        servers = {each.received.server for each in last.requests} if last else set()
        if last and request.received.t - last.t < SAME and request.received.server not in servers:
            last.requests.append(request)
        else:
            found.append(Asked([request]))
    return found


def _offered(run: Transcript, service: str) -> float | None:
    """Return when a server of the right type was first there (s)."""
    times = [
        each.t
        for each in run.all(ev.ServiceOffered)
        if (each.service, each.type) == (service, TYPES[service])
    ]
    return min(times, default=None)


def _gone(run: Transcript, service: str) -> float | None:
    """Return when a server of a service died (s)."""
    return min((each.t for each in run.all(ev.ServiceWithdrawn) if each.service == service), default=None)


def _is_gone(run: Transcript, service: str, t: float) -> bool:
    """Return whether the last server of a service had died by a time (s), and none was to come back by then."""
    gone = [each for each in run.all(ev.ServiceWithdrawn) if each.service == service and each.t <= t]
    there = {each.server for each in run.all(ev.ServiceOffered) if each.service == service and each.t <= t}
    returns = (run.params.get(SCRIPTS[service]) or {}).get("returns")
    if gone and returns is not None and gone[-1].t + returns <= t:
        return False  # whoever waits sees it
    return bool(gone) and not there - {each.server for each in gone}


def _is_missing(run: Transcript, service: str) -> bool | None:
    """Return whether a service counts as missing; None: it may be found, or not."""
    offered = _offered(run, service)
    if offered is None:
        return True
    if offered - started_at(run) <= SURELY_FOUND:
        return False
    return None


def _answers(run: Transcript, service: str) -> tuple[set[bool], list[Any]]:
    """Return whether the service answers (True) or is silent, both if it may count as either; and the responses."""
    sent = asked(run, service)
    replies = [reply for each in sent for reply in each.replies]
    for each in sent:
        if each.is_answered:
            soon = each.replies[0].t + MARGIN
            return {True}, [reply.response for reply in replies if reply.t <= soon] or [replies[0].response]
    return {False} | ({True} if replies else set()), [reply.response for reply in replies]


def expected_ends(run: Transcript) -> tuple[set[bool], str, list[str]]:
    """Return how the run may end (True: success), why it fails, and the messages that may be printed."""
    ends: set[bool] = set()
    why = ""
    for service in (ENABLE, STATUS):
        if _is_missing(run, service):
            other = _offered(run, ENABLE) is None and _offered(run, STATUS) is None
            types = [each for each in run.all(ev.ServiceOffered) if each.service == service]
            why = "is there with another type" if types else "is offered by nobody"
            return {False}, "nobody offers enable_motors and get_status" if other else f"{service} {why}", []
        if _is_missing(run, service) is None:
            ends, why = ends | {False}, f"{service} came late"
    for service in (ENABLE, STATUS):
        answers, responses = _answers(run, service)
        sent = asked(run, service)
        if not sent and ends == set():
            answers = {True}  # it is there, and would have answered
        if False in answers:
            died = _gone(run, service)
            ends, why = (
                ends | {False},
                f"{service} {'died before it answered' if died else 'has not answered'}",
            )
            if True not in answers:
                return {False}, why, []
        if service == ENABLE:
            granted = {response.success for response in responses}
            if False in granted:
                ends, why = ends | {False}, "enable_motors answered success: false"
                if True not in granted:
                    return {False}, why, []
    if (
        responses
        and max(r.t for e in asked(run, STATUS) for r in e.replies) > started_at(run) + WITHIN - MARGIN
    ):
        ends.add(False)
    return ends | {True}, why, [response.message for response in responses]


# -- how it ends ------------------------------------------------------------------------------------------------------


def _failure(expected: str, advice: Advice, at: float) -> Failure:
    return Failure(expected=expected, observed=advice.observed, help=advice.help, at=at)


def require_end(run: Transcript) -> ev.NodeExited:
    """Require that the program ended by itself, in time; if it hung, say where."""
    require_within_limits(run)
    if run.first(ev.NodeExited) is None and run.first(ev.NodeStarted) is not None:
        raise _failure(f"the program to end by itself within {WITHIN:g} s", why_it_hung(run), run.end)
    return client_checks.require_end(run, WITHIN)


@obligation(3, 4, 6, 8, 9, 12, of=whole_run)
def ends_as_it_went(run: Transcript) -> str:
    """It ends with status 0 if both services answered, and with 1 if one was missing, silent or refused"""
    exited = require_end(run)
    ends, why, _messages = expected_ends(run)
    if ends == {True} and exited.returncode != 0:
        raise _failure(
            "exit status 0, because both services were there", why_it_failed(run, exited), exited.t
        )
    if ends == {False} and exited.returncode != 1:
        raise _failure(f"exit status 1: {why}", why_not_one(run, exited), exited.t)
    if exited.returncode not in (0, 1):
        raise _failure("exit status 0 or 1", why_not_one(run, exited), exited.t)
    return why if ends == {False} else "both answer" if ends == {True} else f"either way: {why}"


@obligation(10, of=whole_run)
def says_why_it_fails(run: Transcript) -> str | None:
    """Before it ends with status 1 it says why on stderr, without a traceback, and prints no status"""
    ends, why, _messages = expected_ends(run)
    exited = require_end(run)
    if ends == {True} or (exited.returncode == 0 and ends != {False}):
        return None
    client_checks.require_failure(run, WITHIN, (1,), why)
    expect(
        not _status_lines(run, "stdout"),
        expected=f"no status on stdout: {why}",
        observed=f"“{next(iter(_status_lines(run, 'stdout')), '')}”",
        help="Print the status when get_status has answered, and nothing where the program gives up.",
        at=exited.t,
    )
    return why


@obligation(11, of=whole_run)
def keeps_one_deadline(run: Transcript) -> str | None:
    """It gives up within 10 s in all, counted from the start of its node"""
    exited = require_end(run)
    if exited.returncode == 0:
        return "it succeeds"
    took = gave_up_at(run, exited) - started_at(run)
    when = " and ".join(f"{each.t - started_at(run):.1f} s" for each in asked(run, STATUS))
    expect(
        took <= WITHIN + DEADLINE_SLACK,
        expected=f"it to give up within {WITHIN:g} s in all, however late the servers are",
        observed=f"it gave up after {took:.1f} s; get_status was asked at {when or 'no time'}",
        help="Set one deadline at the start, time.monotonic() + 10.0, and give each wait at most what is left of it.",
        at=gave_up_at(run, exited),
    )
    return "it gives up"


# -- what it asks -----------------------------------------------------------------------------------------------------


@obligation(1, of=whole_run)
def switches_on(run: Transcript) -> str | None:
    """Each request to enable_motors, also the second one, has data true"""
    sent = asked(run, ENABLE)
    if not sent:
        return _never_asked(run, ENABLE)
    for number, each in enumerate(sent):
        expect(
            each.requests[0].message.data,
            expected="data: true, which switches the motors on",
            observed="data: false" + (" in the second request" if number else ""),
            help="A new request holds false: set request.data = True before you send it"
            + (", also the second time." if number else "."),
            at=each.t,
        )
    return "asked"


@obligation(1, of=whole_run)
def enables_then_asks(run: Transcript) -> str | None:
    """It asks enable_motors with data true, each time, and get_status only after the answer"""
    switches_on.judge(run)
    status = asked(run, STATUS)
    if not status:
        return _never_asked(run, STATUS)
    replies = [reply.t for each in asked(run, ENABLE) for reply in each.replies]
    first = min(replies, default=run.end)
    expect(
        bool(replies) and status[0].t >= first,
        expected="get_status to be asked after enable_motors was answered",
        observed=f"{first - status[0].t:.3f} s before" if replies else "it was asked without an answer",
        help="call_async returns at once: wait for the first future before you send the second request, or the "
        "status is that of a robot whose motors are still off.",
        at=status[0].t,
    )
    return "both asked"


def _never_asked(run: Transcript, service: str) -> str | None:
    """Require that a service that was never asked did not have to be; only one that came late shows anything then."""
    ends, _why, _messages = expected_ends(run)
    if ends != {True}:
        late = any(_is_missing(run, each) is None for each in (ENABLE, STATUS))
        return "a server came late, and was not asked" if late else None
    after = " after enable_motors was answered" if service == STATUS else ""
    exited = require_end(run)
    raise _failure(f"a request to {service}{after}", why_it_failed(run, exited), exited.t)


def _repeats(service: str, run: Transcript) -> str | None:
    sent = asked(run, service)
    expected = f"2 requests to {service}: one, and one more when no answer has come within 2 s"
    if not sent:
        return _never_asked(run, service)
    if len(sent) > 2:
        raise Failure(
            expected=expected if not sent[0].is_answered else f"1 request to {service}, which was answered",
            observed=f"{len(sent)} requests",
            help="One retry is allowed: give up when the second request is not answered either.",
            at=sent[-1].t,
        )
    first = sent[0]
    if len(sent) == 1:
        return _require_no_second(run, service, first, expected)
    second = sent[1]
    pause = second.t - first.t
    answered = next((reply for reply in first.replies if reply.t < second.t - MARGIN), None)
    if answered and first.is_answered:
        raise Failure(
            expected=f"1 request to {service}, which was answered",
            observed=f"2 requests: the first was answered after {answered.t - first.t:.1f} s",
            help="Take answers for all of the 2 s: spin the node while you wait. time.sleep takes none."
            if answered.response.success or service == STATUS
            else "success: false is an answer, too: give up, and do not ask again.",
            at=second.t,
        )
    expect(
        SOONEST <= pause <= LATEST,
        expected="the second request 2 s after the first",
        observed=f"{pause:.1f} s after it",
        help="You stop waiting too early: an answer may take 2 s. Wait with timeout_sec=2.0."
        if pause < SOONEST
        else "You wait too long before you ask again: give the first wait timeout_sec=2.0.",
        at=second.t,
    )
    if not second.is_answered and not any(not reply.response.success for reply in first.replies):
        _require_patience(run, service, second)
    return "asked twice"


def _require_no_second(run: Transcript, service: str, first: Asked, expected: str) -> str:
    """Judge a service that was asked once: it answered, or died, or the time was over."""
    if first.is_answered:
        return "answered at once"
    if _is_gone(run, service, first.t + PATIENCE - MARGIN) or first.replies:
        return "its server died, or answered late"
    if first.t + PATIENCE > started_at(run) + WITHIN - 1.0:
        return "the deadline came first"
    exited = require_end(run)
    told = _status_lines(run, "stdout")
    if exited.returncode == 0 and told:
        raise Failure(
            expected=f"the answer of {service} to be waited for",
            observed=f"“{told[0]}” before {service} had answered",
            help="Each request has a future of its own: take the answer from that one alone, and remove the request "
            "you gave up on, so that its late answer goes nowhere.",
            at=exited.t,
        )
    died = any(each.service == service for each in run.all(ev.ServiceWithdrawn))
    raise Failure(
        expected=expected,
        observed="Only one request, then it gave up.",
        help="The server was to come back: wait for the answer for 2 s all the same, and send the second request."
        if died
        else "Where is the second try? Remove the request that was not answered, and send another.",
        at=exited.t,
    )


def _require_patience(run: Transcript, service: str, last: Asked) -> None:
    """Require that the second request got its 2 s, or what was left of the 10 s."""
    exited = require_end(run)
    if exited.returncode == 0 or _is_gone(run, service, exited.t):
        return  # a late answer to the first was used, or nobody was left
    waited = gave_up_at(run, exited) - last.t
    left = started_at(run) + WITHIN - last.t
    expect(
        waited >= min(SOONEST, left - MARGIN),
        expected=f"2 s for the answer to the second request to {service}",
        observed=f"it gave up {waited:.1f} s after it",
        help="An answer may take 2 s, each time: wait with timeout_sec=2.0.",
        at=gave_up_at(run, exited),
    )


@obligation(5, 7, of=whole_run)
def repeats_enable_once(run: Transcript) -> str | None:
    """enable_motors is asked once more, with 2 s for each request, if and only if the first has no answer"""
    return _repeats(ENABLE, run)


@obligation(5, 7, of=whole_run)
def repeats_status_once(run: Transcript) -> str | None:
    """get_status is asked once more, with 2 s for each request, if and only if the first has no answer"""
    return _repeats(STATUS, run)


# -- what it prints ---------------------------------------------------------------------------------------------------


def _status_lines(run: Transcript, stream: str) -> list[str]:
    return [line.rstrip() for line in run.output(stream).splitlines() if line.startswith(PREFIX.rstrip())]


@obligation(2, of=whole_run)
def prints_the_status(run: Transcript) -> str | None:
    """On stdout comes one line, “Robot status: ” with the message of get_status unchanged"""
    ends, _why, messages = expected_ends(run)
    exited = require_end(run)
    if ends == {False} or (exited.returncode != 0 and ends != {True}):
        return None
    printed = _status_lines(run, "stdout")
    expect(
        len(printed) == 1,
        expected=f"one line on stdout that begins with “{PREFIX.rstrip()}”",
        observed=f"{len(printed)} of them" + (": " + " | ".join(printed[:3]) if printed else ""),
        help=how_to_print_one(run, len(printed), PREFIX),
        at=run.end,
        see=PRINTING,
    )
    _require_message(printed[0], messages, run)
    return "a status"


@obligation(2, 12, of=whole_run)
def tells_one_status(run: Transcript) -> str | None:
    """It says one status, the message of get_status, wherever it writes it"""
    ends, _why, messages = expected_ends(run)
    exited = require_end(run)
    if ends == {False} or (exited.returncode != 0 and ends != {True}):
        return None
    logged = [line for line in run.output("stderr").splitlines() if PREFIX.rstrip() in line]
    told = _status_lines(run, "stdout") or [line[line.index(PREFIX.rstrip()) :].rstrip() for line in logged]
    expect(
        len(told) == 1,
        expected="one status",
        observed=f"{len(told)} of them" + (": " + " | ".join(told[:3]) if told else ""),
        help=how_to_print_one(run, len(told), PREFIX),
        at=run.end,
        see=PRINTING,
    )
    _require_message(told[0], messages, run)
    return "a status"


def _require_message(line: str, messages: list[str], run: Transcript) -> None:
    expect(
        line in [(PREFIX + message).rstrip() for message in messages],
        expected=" or ".join(f"“{PREFIX}{message}”" for message in messages)
        or "get_status to be asked first",
        observed=f"“{line}”",
        help="Print the message of the response to get_status, all of it: print(f'Robot status: {response.message}').",
        at=run.end,
        see=PRINTING,
    )


# -- all of it --------------------------------------------------------------------------------------------------------


@obligation(13, of=whole_run)
def asks_here(run: Transcript) -> str:
    """It asks the robot in whose namespace it is started"""
    require_end(run)
    expect(
        bool(run.requests(ENABLE)),
        expected=f"a request to {ENABLE} in the namespace in which the program was started",
        observed=f"none there; the last line on stderr: {run.last_words or 'none'}",
        help=f"Use relative names, “{ENABLE}” without a slash in front: the namespace belongs to whoever starts the "
        "node.",
        at=run.end,
    )
    return "another namespace"


EVERYTHING = (
    *(switches_on, enables_then_asks, repeats_enable_once, repeats_status_once),
    *(ends_as_it_went, says_why_it_fails, tells_one_status, keeps_one_deadline),
)


@obligation(*sorted({clause for each in EVERYTHING for clause in each.clauses}), of=whole_run)
def holds_whatever_servers_do(run: Transcript) -> str:
    """Whatever its servers do, it asks, prints and ends as the clauses say"""
    for each in EVERYTHING:
        each.judge(run)
    ends, why, _messages = expected_ends(run)
    return "both answer" if ends == {True} else why
