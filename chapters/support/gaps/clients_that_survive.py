"""Chapter 3a: a bounded call."""

from __future__ import annotations

import json
from typing import Any

from chapters.support import harness
from lab.learning.gap import Gap, expect, not_yet
from lab.running.programs import run_program

TRIALS_PROGRAM = f"{harness.__path__[0]}/bounded_calls.py"
TRIALS_TIMEOUT = 30.0  # s for all calls of a trial; correct lines need 6 s
SLACK = (
    0.9  # s that a call may take longer: rclpy looks for a server four times a second, and machines are busy
)


def try_calls(function: str, *cases: str) -> list[dict[str, Any]]:
    """Call the student's function in these cases, in a process of its own; return what each call did.

    Raises GapError when a call did not return.
    """
    program = run_program(TRIALS_PROGRAM, function, *cases, timeout=TRIALS_TIMEOUT)
    calls = [json.loads(line) for line in program.stdout.splitlines() if line.startswith("{")]
    if len(calls) == len(cases):
        return calls
    if program.stopped:
        kind, seconds = cases[len(calls)].split(":")
        if float(seconds) < 0:
            raise not_yet(
                f"with a deadline that has passed, {function}() did not return",
                "None, almost at once",
                "give each wait left_until(deadline): to rclpy a negative limit means no limit",
            )
        raise not_yet(
            f"{function}() had not returned although its {seconds} s were over; the server: {kind}",
            "None when the time is up",
            "do not wait again without a limit",
        )
    reason = (program.stderr.strip().splitlines() or ["it printed nothing"])[-1]
    raise not_yet(f"the program ended: {reason}", "a call that returns", "fix the error that is named here")


def looks_and_removes() -> str:
    """Call ask_once at a server that answers, then at one that does not."""
    answered, silent = try_calls("ask_once", "answering:2.0", "silent:0.5")
    for call in (answered, silent):
        _require_no_error(call)
    expect(
        answered["returned"] == "response",
        seen=f"the server answered, and ask_once() returned {answered['returned']}",
        expected="the response",
        next="when future.done(), return future.result()",
    )
    expect(
        silent["returned"] is None,
        seen=f"the server did not answer, and ask_once() returned {silent['returned']}",
        expected="None",
        next="return None when future.done() is false",
    )
    expect(
        not silent["kept"],
        seen="None, but the client still keeps the request that nobody answered",
        expected="a client that has forgotten it",
        next="call client.remove_pending_request(future) before you return None",
    )
    return "an answer is returned; silence is None after 0.5 s, and the client keeps no request"


def keeps_one_deadline() -> str:
    """Call ask at servers that answer, answer late, never answer, and are missing, and when the time is over."""
    answering, first_lost, silent, missing, over = try_calls(
        "ask", "answering:5.0", "first_lost:5.0", "silent:2.5", "missing:0.5", "silent:-1.0"
    )
    for call in (answering, first_lost, silent, missing, over):
        _require_no_error(call)
    expect(
        answering["returned"] == "response" and answering["requests"] == 1,
        seen=f"the server answers: {_in_words(answering)}",
        expected="the response, after one request",
        next="return the response as soon as it is not None",
    )
    expect(
        first_lost["seconds"] < 4.0,
        seen=f"the first request is lost, 5 s are left: {_in_words(first_lost)}",
        expected="a second request after PER_TRY, 2 s",
        next="give a try min(PER_TRY, left_until(deadline))",
    )
    expect(
        first_lost["returned"] == "response",
        seen=f"the first request is lost, 5 s are left: {_in_words(first_lost)}",
        expected="the response to a second request",
        next="try again while response is None, `tries` times in all",
    )
    expect(
        silent["returned"] is None,
        seen=f"no answer at all: {_in_words(silent)}",
        expected="None",
        next="return None after the last try",
    )
    expect(
        silent["seconds"] < 2.5 + SLACK,
        seen=f"no answer, 2.5 s for everything: {_in_words(silent)}",
        expected="None after 2.5 s: 2 s for the first try, 0.5 s for the second",
        next="give each try what is left at that moment: min(PER_TRY, left_until(deadline))",
    )
    expect(
        silent["requests"] <= 2,
        seen=f"no answer, 2 tries: {_in_words(silent)}",
        expected="at most 2 requests",
        next="count the tries: for _ in range(tries)",
    )
    expect(
        missing["returned"] is None and missing["seconds"] < 0.5 + SLACK,
        seen=f"nobody offers the service, 0.5 s for everything: {_in_words(missing)}",
        expected="None after about 0.5 s",
        next="wait_for_service(timeout_sec=left_until(deadline)); when it returns False, return None",
    )
    expect(
        over["returned"] is None and over["seconds"] < SLACK,
        seen=f"the deadline has passed: {_in_words(over)}",
        expected="None at once",
        next="give each wait left_until(deadline)",
    )
    return "five servers, one deadline: it retries what was lost, and never takes longer than it may"


def _require_no_error(call: dict[str, Any]) -> None:
    expect(
        "NotImplementedError" not in call["raised"],
        seen="ask_once() raised NotImplementedError",
        expected="an ask_once() that returns a response, or None",
        next="fill the gap of ask_once.py first",
    )
    expect(
        not call["raised"],
        seen=f"an exception: {call['raised']}",
        expected="a response, or None",
        next="fix the error that is named here",
    )


def _in_words(call: dict[str, Any]) -> str:
    requests = f"{call['requests']} request{'' if call['requests'] == 1 else 's'}"
    return f"it returned {call['returned']} after {call['seconds']:.1f} s and {requests}"


GAPS = (Gap("ask_once.py", looks_and_removes), Gap("bounded.py", keeps_one_deadline))
