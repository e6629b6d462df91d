"""What must hold of every run of the robot controller, whatever its servers do: what is asked, printed and answered."""

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
from .advice import SOONEST, gave_up_at, how_to_print_one, why_it_failed, why_not_one
from .truth import ENABLE, STATUS, WHOLE_DEADLINE, asked, expected_ends

DEADLINE_SLACK = 0.8  # s for the line that says so; ending takes longer, for which `client_checks` allows
LATEST = 3.5  # s between a request and its repetition; 2 s are asked for
SEARCH_SLACK = 1.5  # s, for the end of the search for a server, and the line that says so
PREFIX = "Robot status:"
PRINTING = "03_clients_that_survive#fix-file"  # the lesson
REFUSING = "03b_clients_in_bad_company#success-why"  # the lesson


# -- how it ends ------------------------------------------------------------------------------------------------------


@obligation(3, 4, 6, 8, 9, 12, of=whole_run, see="03_clients_that_survive#fix-frame")
def ends_as_it_went(run: Transcript) -> str:
    """It ends with status 0 if both services answered, and with 1 if one was missing, silent or refused"""
    exited, ends = require_end(run, WHOLE_DEADLINE), expected_ends(run)
    allowed = [0] * ends.may_succeed + [1] * ends.may_fail
    if exited.returncode not in allowed:
        if allowed == [0]:
            for service in (ENABLE, STATUS):
                if asked(run, service):
                    _repeats(service, run)
            observed, help = why_it_failed(run, exited)
            because = ", because both services were there"
        else:
            observed, help = why_not_one(run, exited)
            because = f": {ends.why}" if allowed == [1] else ""
        raise Failure(
            expected=f"exit status {' or '.join(map(str, allowed))}{because}",
            observed=observed,
            help=help,
            at=exited.t,
            see=REFUSING if ends.why == truth.REFUSED else "",
        )
    return "both answer" if allowed == [0] else ends.why if allowed == [1] else f"either way: {ends.why}"


@obligation(10, of=whole_run)
def says_why_it_fails(run: Transcript) -> str | None:
    """Before it ends with status 1 it says why on stderr, without a traceback, and prints no status"""
    exited, ends = require_end(run, WHOLE_DEADLINE), expected_ends(run)
    if not ends.may_fail or (exited.returncode == 0 and ends.may_succeed):
        return None
    require_failure(run, WHOLE_DEADLINE, ends.why)
    printed = _status_lines(run)
    expect(
        not printed,
        expected=f"no status on stdout: {ends.why}",
        observed=f"“{printed[0]}”" if printed else "",
        help="Print the status when get_status has answered, and nothing where the program gives up.",
        at=exited.t,
    )
    return ends.why


@obligation(11, of=whole_run)
def keeps_one_deadline(run: Transcript) -> str | None:
    """It gives up within 10 s in all, counted from the start of its node"""
    exited = require_end(run, WHOLE_DEADLINE)
    if exited.returncode == 0:
        return "it succeeds"
    took = gave_up_at(run, exited) - started_at(run)
    when = " and ".join(f"{each.t - started_at(run):.1f} s" for each in asked(run, STATUS))
    expect(
        took <= WHOLE_DEADLINE + DEADLINE_SLACK,
        expected=f"it to give up within {WHOLE_DEADLINE:g} s in all, however late the servers are",
        observed=f"it gave up after {took:.1f} s; get_status was asked at {when or 'no time'}",
        help="Set one deadline at the start, time.monotonic() + 10.0, and give each wait at most what is left of it.",
        at=gave_up_at(run, exited),
    )
    return "it gives up"


@obligation(4, of=whole_run)
def looks_for_two_seconds(run: Transcript) -> str | None:
    """A server that is not there is looked for for 2 s, from the start on or when it is needed"""
    exited = require_end(run, WHOLE_DEADLINE)
    missing = [service for service in (ENABLE, STATUS) if not truth.offered(run, service)]
    if not missing or exited.returncode == 0:
        return None
    enabled = [reply.t for each in asked(run, ENABLE) for reply in each.replies]
    gave_up = gave_up_at(run, exited)
    least, most = gave_up - started_at(run), gave_up - max([started_at(run), *enabled[:1]])
    expect(
        least >= SOONEST and most <= truth.ANSWER_TIMEOUT * len(missing) + SEARCH_SLACK,
        expected=f"{' and '.join(missing)} to be looked for for {truth.ANSWER_TIMEOUT:g} s"
        + " each" * (len(missing) > 1),
        observed=f"it gave up {most:.1f} s after {'enable_motors had answered' if enabled else 'its start'}",
        help="A server that has not appeared after 2 s is missing: give wait_for_service timeout_sec=2.0.",
        at=gave_up,
    )
    return " and ".join(missing)


# -- what it asks -----------------------------------------------------------------------------------------------------


@obligation(1, of=whole_run, see="03b_clients_in_bad_company#success-why")
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


@obligation(1, of=whole_run, see="03_clients_that_survive#fix-frame")
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
    if expected_ends(run).may_fail:
        late = any(truth.is_missing(run, each) is None for each in (ENABLE, STATUS))
        return "a server came late, and was not asked" if late else None
    after = " after enable_motors was answered" if service == STATUS else ""
    exited = require_end(run, WHOLE_DEADLINE)
    observed, help = why_it_failed(run, exited)
    raise Failure(expected=f"a request to {service}{after}", observed=observed, help=help, at=exited.t)


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
    answered = next((reply for reply in first.replies if reply.t < second.t - truth.ANSWER_MARGIN), None)
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


def _require_no_second(run: Transcript, service: str, first: truth.Asked, expected: str) -> str:
    """Judge a service that was asked once: it answered, or died, or the time was over."""
    if first.is_answered:
        return "answered at once"
    exited = require_end(run, WHOLE_DEADLINE)
    late = first.replies and (
        exited.returncode == 0 or first.replies[0].t <= first.t + truth.ANSWER_TIMEOUT + truth.ANSWER_MARGIN
    )
    if late or truth.is_gone(run, service, first.t + truth.ANSWER_TIMEOUT - truth.ANSWER_MARGIN):
        return "its server died, or answered late"
    if first.t + truth.ANSWER_TIMEOUT > started_at(run) + WHOLE_DEADLINE - 1.0:
        return "the deadline came first"
    told = _status_lines(run)
    if exited.returncode == 0 and told:
        raise Failure(
            expected=f"the answer of {service} to be waited for",
            observed=f"“{told[0]}” before {service} had answered",
            help="Each request has a future of its own: take the answer from that one alone, and remove the request "
            "you gave up on, so that its late answer goes nowhere.",
            at=exited.t,
        )
    raise Failure(
        expected=expected,
        observed="Only one request, then it gave up.",
        help="The server was to come back: wait for the answer for 2 s all the same, and send the second request."
        if truth.died(run, service, run.end)
        else "Where is the second try? Remove the request that was not answered, and send another.",
        at=exited.t,
    )


def _require_patience(run: Transcript, service: str, last: truth.Asked) -> None:
    """Require that the second request got its 2 s, or what was left of the 10 s."""
    exited = require_end(run, WHOLE_DEADLINE)
    if exited.returncode == 0 or truth.is_gone(run, service, exited.t):
        return  # a late answer to the first was used, or nobody was left
    waited = gave_up_at(run, exited) - last.t
    left = started_at(run) + WHOLE_DEADLINE - last.t
    expect(
        waited >= min(SOONEST, left - truth.ANSWER_MARGIN),
        expected=f"2 s for the answer to the second request to {service}",
        observed=f"it gave up {waited:.1f} s after it",
        help="An answer may take 2 s, each time: wait with timeout_sec=2.0.",
        at=gave_up_at(run, exited),
    )


@obligation(5, 7, of=whole_run, see="03_clients_that_survive#fix-why")
def repeats_enable_once(run: Transcript) -> str | None:
    """enable_motors is asked once more, with 2 s for each request, if and only if the first has no answer"""
    return _repeats(ENABLE, run)


@obligation(5, 7, of=whole_run, see="03b_clients_in_bad_company#late-why")
def repeats_status_once(run: Transcript) -> str | None:
    """get_status is asked once more, with 2 s for each request, if and only if the first has no answer"""
    return _repeats(STATUS, run)


# -- what it prints ---------------------------------------------------------------------------------------------------


@obligation(2, of=whole_run)
def prints_the_status(run: Transcript) -> str | None:
    """On stdout comes one line, “Robot status: ” with the message of get_status unchanged"""
    return _require_one(run, _status_lines(run), f"one line on stdout that begins with “{PREFIX}”")


@obligation(2, 12, of=whole_run)
def tells_one_status(run: Transcript) -> str | None:
    """It says one status, the message of get_status, wherever it writes it"""
    logged = [line for line in run.output("stderr").splitlines() if PREFIX in line]
    return _require_one(
        run,
        _status_lines(run) or [line[line.index(PREFIX) :].rstrip() for line in logged],
        "one status",
    )


def _status_lines(run: Transcript) -> list[str]:
    return [line.rstrip() for line in run.output("stdout").splitlines() if line.startswith(PREFIX)]


def _require_one(run: Transcript, told: Sequence[str], expected: str) -> str | None:
    """Require that one status was told where one has to be, and that it is the message of get_status."""
    exited, ends = require_end(run, WHOLE_DEADLINE), expected_ends(run)
    if not ends.may_succeed or (exited.returncode != 0 and ends.may_fail):
        return None
    expect(
        len(told) == 1,
        expected=expected,
        observed=f"{len(told)} of them" + (": " + " | ".join(told[:3]) if told else ""),
        help=how_to_print_one(run, len(told), PREFIX),
        at=run.end,
        see=PRINTING,
    )
    expect(
        told[0] in [f"{PREFIX} {message}".rstrip() for message in ends.messages],
        expected=" or ".join(f"“{PREFIX} {message}”" for message in ends.messages)
        or "get_status to be asked first",
        observed=f"“{told[0]}”",
        help="Print the message of the response to get_status, all of it: print(f'Robot status: {response.message}').",
        at=run.end,
        see=PRINTING,
    )
    return "a status"


# -- all of it --------------------------------------------------------------------------------------------------------


@obligation(13, of=whole_run, see="01_robot_and_graph#names-why")
def asks_here(run: Transcript) -> str:
    """It asks the robot in whose namespace it is started"""
    require_end(run, WHOLE_DEADLINE)
    if not run.requests(ENABLE):
        expected = f"a request to {ENABLE} in the namespace in which the program was started"
        raise Missing(run, expected=expected, never="none came")
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
    """Whatever its servers do, it asks, prints and ends as the clauses say"""
    for each in EVERYTHING:
        each.judge(run)
    return expected_ends(run).why or "both answer"
