"""Chapter 3b: clients in bad company."""

from __future__ import annotations

import re

from chapters.support import harness
from lab.learning.gap import Gap, expect
from lab.learning.gap_check_helpers import last_error_or_line
from lab.running.programs import Program, run_program
from lab.running.student_nodes import run_node

SERVER_PROGRAM = f"{harness.__path__[0]}/trigger_server.py"


def reads_success() -> str:
    """Run forward_fixed.py with a server that refuses, then with one that grants the request."""
    run_node(SERVER_PROGRAM, "forward", "refuses")
    refused = run_program("forward_fixed.py")
    _require_no_traceback(refused)
    expect(
        not refused.stdout.strip(),
        seen=f"the server refused, but the program printed on stdout: {refused.stdout.strip()}",
        expected="nothing on stdout",
        next="when response.success is false, return before this line is printed",
    )
    expect(
        refused.exit_status == 1,
        seen=f"the server refused, but the program ended with exit status {refused.exit_status}",
        expected="exit status 1",
        next="return 1 when response.success is false",
    )
    expect(
        "forward refuses" in refused.stderr,
        seen=f"the server refused, and the program printed on stderr: {refused.stderr.strip() or 'nothing'}",
        expected="the server's message 'forward refuses' on stderr",
        next="print response.message with file=sys.stderr",
    )
    run_node(SERVER_PROGRAM, "forward", "grants")
    granted = run_program("forward_fixed.py")
    _require_no_traceback(granted)
    expect(
        granted.exit_status == 0 and "walks" in granted.stdout,
        seen=f"the server responded success=True; the program: {granted!r}, "
        f"stdout: {granted.stdout.strip() or 'nothing'}",
        expected="exit status 0 and the line 'The robot walks …' on stdout",
        next="return 1 only when response.success is false",
    )
    return "after a refusal: exit status 1 and the server's reason on stderr; after a success: exit status 0"


def sends_a_new_request_each_time() -> str:
    """Run sum_fixed.py while the server adder.py runs."""
    run_node("adder.py")
    program = run_program("sum_fixed.py", "2", "3")
    _require_no_traceback(program)
    sums = re.findall(r"(-?\d+) \+ (-?\d+) = (-?\d+)", program.stdout)
    printed = "; ".join(f"{a} + {b} = {total}" for a, b, total in sums) or "the program printed no sums"
    expect(
        all(int(a) + int(b) == int(total) for a, b, total in sums),
        seen=printed,
        expected="2 + 3 = 5; 20 + 30 = 50",
        next="make a new AddTwoInts.Request for each call: the second call has overwritten the first request",
    )
    expect(
        [total for *_, total in sums] == ["5", "50"],
        seen=printed,
        expected="2 + 3 = 5; 20 + 30 = 50",
        next="append (request, future) to `sent` twice: once with a and b, once with 10 * a and 10 * b",
    )
    return printed


def _require_no_traceback(program: Program) -> None:
    expect(
        "Traceback" not in program.stderr,
        seen=last_error_or_line(program.stderr, program.file.name),
        expected="no exception",
        next="fix the error that is named here",
    )
    expect(
        not program.stopped,
        seen=repr(program),
        expected="a program that ends by itself",
        next="do not wait without a limit",
    )


GAPS = (Gap("forward_fixed.py", reads_success), Gap("sum_fixed.py", sends_a_new_request_each_time))
