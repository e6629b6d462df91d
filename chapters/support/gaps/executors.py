"""Chapter 5: executors."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from typing import Any

from std_msgs.msg import Empty
from std_srvs.srv import Trigger

from chapters.support import harness
from lab.client.connection import connection
from lab.client.services import call
from lab.client.waiting import becomes_true
from lab.errors import NoAnswerError, NoServerError
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import last_error_or_line
from lab.running.programs import run_program
from lab.running.student_nodes import StudentNode, run_node

SERVER_PROGRAM = f"{harness.__path__[0]}/trigger_server.py"
WAITS_PROGRAM = f"{harness.__path__[0]}/timed_waits.py"
LOOK_DURATION = 3.0  # s that look_around takes
MAX_GAP = 1.0  # s between two heartbeats on a busy machine; a blocked heartbeat waits for LOOK_DURATION
FIRST_BEATS_TIMEOUT = 5.0  # s
REPORT_TIMEOUT = 3.0  # s; the node's own request to where_am_i has a limit of 1 s
DISCOVERY_TIMEOUT = 15.0  # s until a new server and its client have discovered each other
EXIT_TIMEOUT = 1.0  # s until a node exits after an exception
POSITION = "x 1.00 m, y 0.00 m"


def heartbeat_continues_during_the_sleep() -> str:
    """Call look_around of two_groups.py, and measure the gaps between its heartbeats."""
    gap, _ = _look_around(run_node("two_groups.py"))
    expect(
        gap < MAX_GAP,
        seen=f"a gap of {gap:.1f} s between two heartbeats while look_around slept",
        expected=f"a gap of less than {MAX_GAP} s",
        next="give super().__init__() a beat_group that look_around does not share: "
        "None is the default group, and one exclusive group for both blocks the heartbeat, too",
    )
    return f"it looked around, and the longest gap between two heartbeats was {gap:.2f} s"


def waits_without_a_thread() -> str:
    """Call look_around of awaiting.py twice; the node has one thread."""
    node = run_node("awaiting.py")
    for _ in range(2):
        gap, took = _look_around(node)
        expect(
            gap < MAX_GAP,
            seen=f"a gap of {gap:.1f} s between two heartbeats",
            expected=f"a gap of less than {MAX_GAP} s",
            next="await a Future that a timer completes: a blocking call occupies the only thread",
        )
        expect(
            took > LOOK_DURATION - 0.3,
            seen=f"look_around responded after {took:.1f} s",
            expected=f"a response after {LOOK_DURATION:g} s",
            next="await the future before you return, and give the timer the period `seconds`",
        )
    _require_a_timer_for_each_wait("awaiting", "Awaiting", "wait")
    return f"it looked around twice on one thread; the longest gap between two heartbeats was {gap:.2f} s"


def reports_or_refuses() -> str:
    """Request reports while where_am_i is missing, responds, is missing again, and does not respond."""
    node = run_node("report_fixed.py")
    _expect_refusal(node, "no server offers where_am_i")
    responds = "where_am_i responds"
    with _where_am_i():
        if not becomes_true(lambda: _report(node, responds).success, DISCOVERY_TIMEOUT):
            raise not_yet(
                f"the report has success=False although {responds}",
                f"success=True and the position {POSITION!r}",
                "let ask() return the value of `await future`",
            )
        answer = _report(node, responds).message
        expect(
            POSITION in answer,
            seen=f"the report has the message {answer!r}",
            expected=f"a message with the position {POSITION!r}",
            next="let ask() return the value of `await future`, which is the response of where_am_i",
        )
    _expect_refusal(node, "the server of where_am_i has ended")
    silent = run_node(SERVER_PROGRAM, "where_am_i", "ignores")

    def has_been_ignored() -> bool:
        _expect_refusal(node, "where_am_i does not respond")
        return "ignored" in silent.log()

    expect(
        becomes_true(has_been_ignored, DISCOVERY_TIMEOUT),
        seen="where_am_i received no request",
        expected="a request to where_am_i for each report",
        next="send the request with self.client.call_async(Trigger.Request())",
    )
    _require_a_timer_for_each_wait("report_fixed", "Report", "ask")
    return "it reported the position, and responded success=False three times when where_am_i gave none"


def _require_a_timer_for_each_wait(module: str, node: str, coroutine: str) -> None:
    """Require that a timer of the node ends the wait of a coroutine, and that the wait leaves no timer behind."""
    timers = json.loads(run_program(WAITS_PROGRAM, module, node, coroutine).stdout.splitlines()[-1])
    expect(
        timers["fired"],
        seen="the wait ended, but no timer of the node fired",
        expected="a timer that ends the wait",
        next="end the wait with self.create_timer: a loop keeps the processor busy, and the executor does not notice "
        "when a thread of your own completes the future",
    )
    expect(
        not timers["left"],
        seen="the wait ended, and the node still has its timer",
        expected="no timer of the wait at its end",
        next="call self.destroy_timer() after the await: otherwise each wait leaves one more timer, also a cancelled "
        "one",
    )


def _look_around(node: StudentNode) -> tuple[float, float]:
    """Call look_around; return the longest gap between two heartbeats and the duration of the call, both in s."""
    beats: list[float] = []
    subscription = connection().node.create_subscription(
        Empty, "heartbeat", lambda _: beats.append(time.monotonic()), 10
    )
    try:
        if (
            not becomes_true(lambda: len(beats) > 3 or not node.is_running, FIRST_BEATS_TIMEOUT)
            or not node.is_running
        ):
            raise not_yet(
                f"no heartbeat arrived{_error_in_log(node)}",
                "ten heartbeats a second",
                "call super().__init__(…)",
            )
        called_at = time.monotonic()
        try:
            call("look_around", Trigger, timeout=2 * LOOK_DURATION)
        except (NoAnswerError, NoServerError):
            raise _no_answer(node) from None
        took = time.monotonic() - called_at
        seen = len(beats)
        becomes_true(lambda: len(beats) > seen + 1, LOOK_DURATION)  # a gap ends with the next heartbeat
    finally:
        connection().node.destroy_subscription(subscription)
    return max(later - earlier for earlier, later in pairwise(beats)), took


def _no_answer(node: StudentNode) -> Exception:
    ended = becomes_true(lambda: not node.is_running, EXIT_TIMEOUT)
    error = _error_in_log(node) if ended else ""
    advice = (
        "await an rclpy Future: asyncio's event loop doesn't run here"
        if "event loop" in error
        else "fix the error that is named here"
        if ended
        else "let a timer complete the future, and give the timer callback_group=self.waiting: "
        "the default group runs no other callback while look_around awaits"
    )
    return not_yet(f"look_around did not respond{error}", f"a response after {LOOK_DURATION:g} s", advice)


def _expect_refusal(node: StudentNode, situation: str) -> None:
    answer = _report(node, situation)
    expect(
        not answer.success,
        seen=f"{situation}, but the report has success=True and the message {answer.message!r}",
        expected="success=False",
        next="let ask() return None when the time is up: None is the value of `await future` then",
    )


def _report(node: StudentNode, situation: str) -> Any:
    try:
        return call("report", Trigger, timeout=REPORT_TIMEOUT)
    except (NoAnswerError, NoServerError):
        pass
    if becomes_true(lambda: not node.is_running, EXIT_TIMEOUT):
        raise not_yet(
            f"the service report did not respond{_error_in_log(node)}",
            "a report",
            "fix the error that is named here",
        )
    raise not_yet(
        f"{situation}, and the service report did not respond within {REPORT_TIMEOUT:g} s; the node still runs",
        "a report within about 1 s",
        "let a timer call future.cancel after `seconds`, and give the timer callback_group=self.asking: "
        "the default group runs no other callback while on_request awaits",
    )


@contextmanager
def _where_am_i() -> Iterator[None]:
    """Offer where_am_i, with a fixed position, while the block runs."""

    def answer(_: Any, response: Any) -> Any:
        response.success, response.message = True, POSITION
        return response

    service = connection().node.create_service(Trigger, "where_am_i", answer)
    try:
        yield
    finally:
        connection().node.destroy_service(service)


def _error_in_log(node: StudentNode) -> str:
    """Return the last error of a node that has ended as the end of a `seen` sentence; "" if it still runs."""
    return (
        "" if node.is_running else f"; the node has ended: {last_error_or_line(node.log(), node.file.name)}"
    )


GAPS = (
    Gap("two_groups.py", heartbeat_continues_during_the_sleep),
    Gap("awaiting.py", waits_without_a_thread, duration=10),
    Gap("report_fixed.py", reports_or_refuses, duration=8),
)
