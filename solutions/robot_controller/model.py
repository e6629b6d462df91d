"""What must hold for every run of the robot controller, whatever its servers do: requests, output and exit status."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.authoring import (
    Failure,
    Missing,
    Transcript,
    expect,
    obligation,
    require_end,
    require_failure,
    started_at,
    whole_run,
)

from . import truth
from .advice import MIN_WAIT, gave_up_at, how_to_print_one, why_it_failed, why_not_one
from .truth import ENABLE, STATUS, WHOLE_DEADLINE, asked, expected_ends

DEADLINE_SLACK = 0.8  # s, for printing the reason; `require_end` allows more for exiting
MAX_WAIT = 3.5  # s for a response before the retry; the task says 2 s
SEARCH_SLACK = 1.5  # s, for the end of the wait for a server, and for printing the reason
PREFIX = "Robot status:"
PRINTING = "03_clients_that_survive#fix-file"  # the lesson
REFUSING = "03b_clients_in_bad_company#success-why"  # the lesson


# -- the exit ---------------------------------------------------------------------------------------------------------


@obligation(3, 4, 6, 8, 9, 12, of=whole_run, see="03_clients_that_survive#fix-frame")
def ends_as_it_went(run: Transcript) -> str:
    """It exits with status 0 if both services responded; with 1 if one was missing, did not respond or refused"""
    exited, ends = require_end(run, WHOLE_DEADLINE), expected_ends(run)
    allowed = [0] * ends.may_succeed + [1] * ends.may_fail
    if exited.returncode not in allowed:
        if allowed == [0]:
            for service in (ENABLE, STATUS):
                if asked(run, service):
                    _repeats(service, run)
            observed, help = why_it_failed(run, exited)
            because = ", because both services responded"
        else:
            observed, help = why_not_one(run, exited)
            because = f", because {ends.why}" if allowed == [1] else ""
        raise Failure(
            expected=f"exit status {' or '.join(map(str, allowed))}{because}",
            observed=observed,
            help=help,
            at=exited.t,
            see=REFUSING if ends.why == truth.REFUSED else "",
        )
    return "both respond" if allowed == [0] else ends.why if allowed == [1] else f"either status: {ends.why}"


@obligation(10, of=whole_run)
def says_why_it_fails(run: Transcript) -> str | None:
    """Before it exits with status 1, it prints the reason on stderr, without a traceback, and no status"""
    exited, ends = require_end(run, WHOLE_DEADLINE), expected_ends(run)
    if not ends.may_fail or (exited.returncode == 0 and ends.may_succeed):
        return None
    require_failure(run, WHOLE_DEADLINE, ends.why)
    printed = _status_lines(run)
    expect(
        not printed,
        expected=f"no status on stdout, because {ends.why}",
        observed=f"“{printed[0]}”" if printed else "",
        help="Print the status only when get_status has responded, not when the program gives up.",
        at=exited.t,
    )
    return ends.why


@obligation(11, of=whole_run)
def keeps_one_deadline(run: Transcript) -> str | None:
    """It gives up within 10 s in total, counted from the start of its node"""
    exited = require_end(run, WHOLE_DEADLINE)
    if exited.returncode == 0:
        return "succeeds"
    took = gave_up_at(run, exited) - started_at(run)
    when = " and ".join(f"{each.t - started_at(run):.1f} s" for each in asked(run, STATUS))
    expect(
        took <= WHOLE_DEADLINE + DEADLINE_SLACK,
        expected=f"the program to give up within {WHOLE_DEADLINE:g} s in total, however late the servers are",
        observed=f"it gave up after {took:.1f} s; get_status was {f'called after {when}' if when else 'never called'}",
        help="Set one deadline at the start, time.monotonic() + 10.0, and use the remaining time as the limit of each "
        "timeout.",
        at=gave_up_at(run, exited),
    )
    return "gives up"


@obligation(4, of=whole_run)
def looks_for_two_seconds(run: Transcript) -> str | None:
    """It waits 2 s for a missing server, from the start on or when it needs the server"""
    exited = require_end(run, WHOLE_DEADLINE)
    missing = [service for service in (ENABLE, STATUS) if not truth.offered(run, service)]
    if not missing or exited.returncode == 0:
        return None
    enabled = [reply.t for each in asked(run, ENABLE) for reply in each.replies]
    gave_up = gave_up_at(run, exited)
    least, most = gave_up - started_at(run), gave_up - max([started_at(run), *enabled[:1]])
    expect(
        least >= MIN_WAIT and most <= truth.ANSWER_TIMEOUT * len(missing) + SEARCH_SLACK,
        expected=f"a wait of {truth.ANSWER_TIMEOUT:g} s for {' and '.join(missing)}"
        + " each" * (len(missing) > 1),
        observed=f"it gave up {most:.1f} s after {'the response of enable_motors' if enabled else 'its start'}",
        help="Call wait_for_service with timeout_sec=2.0: a server that has not appeared by then is missing.",
        at=gave_up,
    )
    return " and ".join(missing)


# -- the requests -----------------------------------------------------------------------------------------------------


@obligation(1, of=whole_run, see="03b_clients_in_bad_company#success-why")
def switches_on(run: Transcript) -> str | None:
    """Each request to enable_motors, also a retry, has data true"""
    sent = asked(run, ENABLE)
    if not sent:
        return _never_asked(run, ENABLE)
    for number, each in enumerate(sent):
        expect(
            each.requests[0].message.data,
            expected="data: true, which switches the motors on",
            observed="data: false" + (" in the retry" if number else ""),
            help="In a new request data is false: set request.data = True before you send it"
            + (", also in the retry." if number else "."),
            at=each.t,
        )
    return "called"


@obligation(1, of=whole_run, see="03_clients_that_survive#fix-frame")
def enables_then_asks(run: Transcript) -> str | None:
    """It calls enable_motors with data true, and get_status only after the response"""
    switches_on.judge(run)
    status = asked(run, STATUS)
    if not status:
        return _never_asked(run, STATUS)
    replies = [reply.t for each in asked(run, ENABLE) for reply in each.replies]
    first = min(replies, default=run.end)
    expect(
        bool(replies) and status[0].t >= first,
        expected="get_status to be called after the response of enable_motors",
        observed=f"it was called {first - status[0].t:.3f} s before the response"
        if replies
        else "it was called, but enable_motors had not responded",
        help="call_async returns at once: wait for the first future before you send the second request. Otherwise the "
        "motors may still be off in the status.",
        at=status[0].t,
    )
    return "both called"


def _never_asked(run: Transcript, service: str) -> str | None:
    """Require that a service without a request did not need one; return the situation if its server came late."""
    if expected_ends(run).may_fail:
        late = any(truth.is_missing(run, each) is None for each in (ENABLE, STATUS))
        return "a server came late, and was not called" if late else None
    after = " after the response of enable_motors" if service == STATUS else ""
    exited = require_end(run, WHOLE_DEADLINE)
    observed, help = why_it_failed(run, exited)
    raise Failure(expected=f"a request to {service}{after}", observed=observed, help=help, at=exited.t)


def _repeats(service: str, run: Transcript) -> str | None:
    sent = asked(run, service)
    expected = f"2 requests to {service}: one, and a retry after 2 s without a response"
    if not sent:
        return _never_asked(run, service)
    if len(sent) > 2:
        raise Failure(
            expected=expected if not sent[0].is_answered else f"1 request to {service}, as it got a response",
            observed=f"{len(sent)} requests",
            help="Retry only once: give up when the second request gets no response either.",
            at=sent[-1].t,
        )
    first = sent[0]
    if len(sent) == 1:
        return _require_no_second(run, service, first, expected)
    second = sent[1]
    pause = second.t - first.t
    answered = next((reply for reply in first.replies if reply.t < second.t - truth.ANSWER_MARGIN), None)
    if answered and first.is_answered:
        raise Failure(
            expected=f"1 request to {service}, as it got a response",
            observed=f"2 requests, although the response to the first came after {answered.t - first.t:.1f} s",
            help="Spin the node while you wait for up to 2 s: during time.sleep no response is processed."
            if answered.response.success or service == STATUS
            else "success false is a response, too: give up without a retry.",
            at=second.t,
        )
    expect(
        MIN_WAIT <= pause <= MAX_WAIT,
        expected="the retry 2 s after the first request",
        observed=f"the retry after {pause:.1f} s",
        help="The retry comes too early, as a response may take 2 s: wait with timeout_sec=2.0."
        if pause < MIN_WAIT
        else "The retry comes too late: wait for the first response with timeout_sec=2.0.",
        at=second.t,
    )
    if not second.is_answered and not any(not reply.response.success for reply in first.replies):
        _require_patience(run, service, second)
    return "called twice"


def _require_no_second(run: Transcript, service: str, first: truth.Asked, expected: str) -> str:
    """Require that a service with one request needed no retry: it responded, died, or the deadline came."""
    if first.is_answered:
        return "responded at once"
    exited = require_end(run, WHOLE_DEADLINE)
    late = first.replies and (
        exited.returncode == 0 or first.replies[0].t <= first.t + truth.ANSWER_TIMEOUT + truth.ANSWER_MARGIN
    )
    if late or truth.is_gone(run, service, first.t + truth.ANSWER_TIMEOUT - truth.ANSWER_MARGIN):
        return "its server died or responded late"
    if first.t + truth.ANSWER_TIMEOUT > started_at(run) + WHOLE_DEADLINE - 1.0:
        return "the deadline came first"
    told = _status_lines(run)
    if exited.returncode == 0 and told:
        raise Failure(
            expected=f"a wait for the response of {service}",
            observed=f"“{told[0]}” before {service} had responded",
            help="Each request has its own future: take the response only from that future. Call "
            "remove_pending_request for a request that timed out, so that a late response is ignored.",
            at=exited.t,
        )
    raise Failure(
        expected=expected,
        observed="1 request, then it gave up",
        help="Also when a server has died, wait 2 s for the response, then send the second request: the server may "
        "come back."
        if truth.died(run, service, run.end)
        else "After 2 s without a response, call remove_pending_request and send the request once more.",
        at=exited.t,
    )


def _require_patience(run: Transcript, service: str, last: truth.Asked) -> None:
    """Require a wait of 2 s for the response to the second request, or of the time left of the 10 s."""
    exited = require_end(run, WHOLE_DEADLINE)
    if exited.returncode == 0 or truth.is_gone(run, service, exited.t):
        return  # it used a late response to the first request, or no server was left
    waited = gave_up_at(run, exited) - last.t
    left = started_at(run) + WHOLE_DEADLINE - last.t
    expect(
        waited >= min(MIN_WAIT, left - truth.ANSWER_MARGIN),
        expected=f"a wait of 2 s for the response to the second request to {service}",
        observed=f"it gave up {waited:.1f} s after the second request",
        help="A response may take up to 2 s: wait with timeout_sec=2.0 after each request.",
        at=gave_up_at(run, exited),
    )


@obligation(5, 7, of=whole_run, see="03_clients_that_survive#fix-why")
def repeats_enable_once(run: Transcript) -> str | None:
    """enable_motors is called once more only if the first response does not come within 2 s; then it waits 2 s again"""
    return _repeats(ENABLE, run)


@obligation(5, 7, of=whole_run, see="03b_clients_in_bad_company#late-why")
def repeats_status_once(run: Transcript) -> str | None:
    """get_status is called once more only if the first response does not come within 2 s; then it waits 2 s again"""
    return _repeats(STATUS, run)


# -- the output -------------------------------------------------------------------------------------------------------


@obligation(2, of=whole_run)
def prints_the_status(run: Transcript) -> str | None:
    """It prints one line on stdout, “Robot status: ” with the unchanged message of get_status"""
    return _require_one(run, _status_lines(run), f"one line on stdout that begins with “{PREFIX}”")


@obligation(2, 12, of=whole_run)
def tells_one_status(run: Transcript) -> str | None:
    """It writes one status, the message of get_status, on stdout or stderr"""
    logged = [line for line in run.output("stderr").splitlines() if PREFIX in line]
    return _require_one(
        run,
        _status_lines(run) or [line[line.index(PREFIX) :].rstrip() for line in logged],
        "one status",
    )


def _status_lines(run: Transcript) -> list[str]:
    return [line.rstrip() for line in run.output("stdout").splitlines() if line.startswith(PREFIX)]


def _require_one(run: Transcript, told: Sequence[str], expected: str) -> str | None:
    """Require that exactly one status was written, if one has to be, and that it is the message of get_status."""
    exited, ends = require_end(run, WHOLE_DEADLINE), expected_ends(run)
    if not ends.may_succeed or (exited.returncode != 0 and ends.may_fail):
        return None
    expect(
        len(told) == 1,
        expected=expected,
        observed=f"{len(told)} such lines" + (": " + " | ".join(told[:3]) if told else ""),
        help=how_to_print_one(run, len(told), PREFIX),
        at=run.end,
        see=PRINTING,
    )
    expect(
        told[0] in [f"{PREFIX} {message}".rstrip() for message in ends.messages],
        expected=" or ".join(f"“{PREFIX} {message}”" for message in ends.messages)
        or "no status, as get_status was not called",
        observed=f"“{told[0]}”",
        help="Print the whole message of the response of get_status: print(f'Robot status: {response.message}').",
        at=run.end,
        see=PRINTING,
    )
    return "a status"


# -- everything together ----------------------------------------------------------------------------------------------


@obligation(13, of=whole_run, see="01_robot_and_graph#names-why")
def asks_here(run: Transcript) -> str:
    """It calls the services of the robot in the namespace in which it is started"""
    require_end(run, WHOLE_DEADLINE)
    if not run.requests(ENABLE):
        expected = f"a request to {ENABLE} in the namespace in which the program was started"
        raise Missing(run, expected=expected, never="no request came")
    return "another namespace"


EVERYTHING = (
    *(switches_on, enables_then_asks, repeats_enable_once, repeats_status_once),
    *(ends_as_it_went, says_why_it_fails, tells_one_status, keeps_one_deadline),
)


@obligation(
    *sorted({clause for each in EVERYTHING for clause in each.clauses}),
    of=whole_run,
    see="03_clients_that_survive#restart-why",
)
def holds_whatever_servers_do(run: Transcript) -> str:
    """Every clause holds, whatever the servers do"""
    for each in EVERYTHING:
        each.judge(run)
    return expected_ends(run).why or "both respond"
