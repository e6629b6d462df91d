"""Chapter 3a: a bounded call."""

from __future__ import annotations

import json
from typing import Any

from chapters.support import harness
from lab.learning.gap import Gap, expect, not_yet
from lab.running.programs import run_program

TRIALS_PROGRAM = f"{harness.__path__[0]}/bounded_calls.py"
TRIALS_TIMEOUT = 30.0  # s for all calls of a check; correct lines need 6 s
SLACK = 0.9  # s beyond the deadline: rclpy looks for a server only four times a second, and machines are busy
KINDS = {
    "answering": "a server that responds",
    "first_lost": "a server that ignores the first request",
    "silent": "a server that never responds",
    "missing": "no server",
}


def try_calls(function: str, *cases: str) -> list[dict[str, Any]]:
    """Call the student's function in a separate process, once for each case; return the outcome of each call.

    A case is a kind of server and a limit in s, such as "silent:0.5".

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
                f"{function}() did not return although its deadline had already passed when it was called",
                "None, almost at once",
                "give each wait left_until(deadline): for rclpy a negative timeout means no timeout",
            )
        raise not_yet(
            f"with {KINDS[kind]}, {function}() did not return within its limit of {seconds} s",
            "None when the time is up",
            "give each wait a limit",
        )
    reason = (program.stderr.strip().splitlines() or ["it printed nothing"])[-1]
    raise not_yet(f"the program ended: {reason}", "a call that returns", "fix the error that is named here")


def returns_the_response_or_removes_the_request() -> str:
    """Call ask_once with a server that responds, then with one that does not."""
    answered, silent = try_calls("ask_once", "answering:2.0", "silent:0.5")
    for call in (answered, silent):
        _require_no_error(call)
    expect(
        answered["returned"] == "response",
        seen=f"the server responded, but ask_once() returned {answered['returned']}",
        expected="the response",
        next="when future.done() is true, return future.result()",
    )
    expect(
        silent["returned"] is None,
        seen=f"the server did not respond, but ask_once() returned {silent['returned']}",
        expected="None",
        next="return None when future.done() is false",
    )
    expect(
        not silent["kept"],
        seen="ask_once() returned None, but the client still stores the request without a response",
        expected="a client without pending requests",
        next="call client.remove_pending_request(future) before you return None",
    )
    return "it returns a response, or None after 0.5 s without one; then the client stores no pending request"


def keeps_one_deadline() -> str:
    """Call ask while the server responds, ignores one request, never responds, is missing, and after the deadline."""
    answering, first_lost, silent, missing, over = try_calls(
        "ask", "answering:5.0", "first_lost:5.0", "silent:2.5", "missing:0.5", "silent:-1.0"
    )
    for call in (answering, first_lost, silent, missing, over):
        _require_no_error(call)
    expect(
        answering["returned"] == "response" and answering["requests"] == 1,
        seen=f"the server responds to each request, but {_in_words(answering)}",
        expected="the response after one request",
        next="return the response as soon as it is not None",
    )
    expect(
        first_lost["seconds"] < 4.0,
        seen=f"the first request got no response and 5 s were left, but {_in_words(first_lost)}",
        expected="a second request after PER_TRY, which is 2 s",
        next="limit each try to min(PER_TRY, left_until(deadline))",
    )
    expect(
        first_lost["returned"] == "response",
        seen=f"the first request got no response and 5 s were left, but {_in_words(first_lost)}",
        expected="the response to a second request",
        next="try again while the response is None, `tries` times in total",
    )
    expect(
        silent["returned"] is None,
        seen=f"the server never responds, but {_in_words(silent)}",
        expected="None",
        next="return None after the last try",
    )
    expect(
        silent["seconds"] < 2.5 + SLACK,
        seen=f"the server never responds and the deadline is 2.5 s away, but {_in_words(silent)}",
        expected="None after 2.5 s: 2 s for the first try, 0.5 s for the second",
        next="limit each try to the time that is left when it begins: min(PER_TRY, left_until(deadline))",
    )
    expect(
        silent["requests"] <= 2,
        seen=f"the server never responds and 2 tries are allowed, but {_in_words(silent)}",
        expected="at most 2 requests",
        next="count the tries: for _ in range(tries)",
    )
    expect(
        missing["returned"] is None and missing["seconds"] < 0.5 + SLACK,
        seen=f"no server offers the service and the deadline is 0.5 s away, but {_in_words(missing)}",
        expected="None after about 0.5 s",
        next="call wait_for_service(timeout_sec=left_until(deadline)); when it returns False, return None",
    )
    expect(
        over["returned"] is None and over["seconds"] < SLACK,
        seen=f"the deadline has already passed, but {_in_words(over)}",
        expected="None at once",
        next="give each wait left_until(deadline)",
    )
    return "in five situations it sent no more requests than allowed and returned before the deadline"


def _require_no_error(call: dict[str, Any]) -> None:
    expect(
        "NotImplementedError" not in call["raised"],
        seen="ask_once() raised NotImplementedError",
        expected="ask_once() returns a response or None",
        next="fill the gap of ask_once.py first",
    )
    expect(
        not call["raised"],
        seen=f"the function raised {call['raised']}",
        expected="a response or None",
        next="fix the error that is named here",
    )


def _in_words(call: dict[str, Any]) -> str:
    requests = f"{call['requests']} request{'' if call['requests'] == 1 else 's'}"
    return f"it returned {call['returned']} after {call['seconds']:.1f} s and {requests}"


GAPS = (
    Gap("ask_once.py", returns_the_response_or_removes_the_request),
    Gap("bounded.py", keeps_one_deadline),
)
