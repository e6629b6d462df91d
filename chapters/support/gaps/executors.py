"""What the student's lines in chapter 5 are checked for."""

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
from lab.client.waiting import comes_true
from lab.errors import NoAnswerError, NoServerError
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import last_error_or_line
from lab.running.programs import run_program
from lab.running.student_nodes import StudentNode, run_node

SERVER_PROGRAM = f"{harness.__path__[0]}/trigger_server.py"
WAITS_PROGRAM = f"{harness.__path__[0]}/timed_waits.py"
LOOK_DURATION = 3.0  # s that look_around takes
LONGEST_GAP = 1.0  # s between two heartbeats, also on a busy machine; a blocked one waits for LOOK_DURATION
FIRST_BEATS_TIMEOUT = 5.0  # s until the first heartbeats have come
REPORT_TIMEOUT = 3.0  # s for a report; its question has a limit of 1 s
DISCOVERY_TIMEOUT = 15.0  # s until a new server and its client have found each other
EXIT_TIMEOUT = 1.0  # s; a node that an exception ends is gone by then
POSITION = "x 1.00 m, y 0.00 m"


def heart_beats_beside_the_sleep() -> str:
    """Ask two_groups.py to look around, and listen to its heartbeat."""
    gap, _ = _look_around(run_node("two_groups.py"))
    expect(
        gap < LONGEST_GAP,
        seen=f"a gap of {gap:.1f} s between two heartbeats while look_around slept",
        expected=f"less than {LONGEST_GAP} s",
        next="give super().__init__() a group for beat_group in which look_around is not: "
        "None is the default group, and one exclusive group for both is no better",
    )
    return f"it looked around, and the longest gap between two heartbeats was {gap:.2f} s"


def waits_without_a_thread() -> str:
    """Ask awaiting.py to look around, twice, on its only thread."""
    node = run_node("awaiting.py")
    for _ in range(2):
        gap, took = _look_around(node)
        expect(
            gap < LONGEST_GAP,
            seen=f"a gap of {gap:.1f} s between two heartbeats",
            expected=f"less than {LONGEST_GAP} s",
            next="await a Future that a timer completes: what blocks keeps the only thread",
        )
        expect(
            took > LOOK_DURATION - 0.3,
            seen=f"the answer after {took:.1f} s",
            expected=f"after {LOOK_DURATION:g} s",
            next="await the future before you return; the timer's period is `seconds`",
        )
    _require_a_timer_for_each_wait("awaiting", "Awaiting", "wait")
    return f"it looked around twice on one thread; the longest gap between two heartbeats was {gap:.2f} s"


def reports_or_says_why_not() -> str:
    """Ask for a report without a where_am_i, with one, without one again, and with one that keeps silent."""
    node = run_node("report_fixed.py")
    _expect_refusal(node, "nobody offers where_am_i")
    answers = "where_am_i answers"
    with _where_am_i():
        if not comes_true(lambda: _report(node, answers).success, DISCOVERY_TIMEOUT):
            raise not_yet(
                f"success=False, although {answers}",
                f"the position, {POSITION!r}",
                "let ask() return what `await future` gives you",
            )
        answer = _report(node, answers).message
        expect(
            POSITION in answer,
            seen=f"the report {answer!r}",
            expected=f"one with the position {POSITION!r}",
            next="let ask() return the response of where_am_i, which `await future` gives you",
        )
    _expect_refusal(node, "where_am_i has gone")
    silent = run_node(SERVER_PROGRAM, "where_am_i", "ignores")

    def has_been_ignored() -> bool:
        _expect_refusal(node, "where_am_i keeps silent")
        return "ignored" in silent.log()

    expect(
        comes_true(has_been_ignored, DISCOVERY_TIMEOUT),
        seen="no request at where_am_i",
        expected="a request for each report",
        next="send it with self.client.call_async(Trigger.Request())",
    )
    _require_a_timer_for_each_wait("report_fixed", "Report", "ask")
    return "it reported the position, and said so three times when nobody told it"


def _require_a_timer_for_each_wait(module: str, node: str, coroutine: str) -> None:
    """Require that a timer of the node ends the wait of a coroutine, and does not call again."""
    calls = json.loads(run_program(WAITS_PROGRAM, module, node, coroutine).stdout.splitlines()[-1])
    expect(
        calls["until_the_end"],
        seen="the wait ended without a call of a timer",
        expected="a timer that ends it",
        next="end it by self.create_timer: a loop keeps the processor busy, and the executor does not notice what a "
        "thread of your own does",
    )
    expect(
        not calls["after"],
        seen=f"after the wait its timer called {calls['after']} times in a second",
        expected="a timer that calls once",
        next="call self.destroy_timer() after the await: each wait leaves one more timer that calls for ever",
    )


def _look_around(node: StudentNode) -> tuple[float, float]:
    """Return the longest gap between two heartbeats while the node looks around, and how long that took, in s."""
    beats: list[float] = []
    subscription = connection().node.create_subscription(
        Empty, "heartbeat", lambda _: beats.append(time.monotonic()), 10
    )
    try:
        if (
            not comes_true(lambda: len(beats) > 3 or not node.is_running, FIRST_BEATS_TIMEOUT)
            or not node.is_running
        ):
            raise not_yet(f"no heartbeat{_complaint(node)}", "ten a second", "call super().__init__(…)")
        asked = time.monotonic()
        try:
            call("look_around", Trigger, timeout=2 * LOOK_DURATION)
        except (NoAnswerError, NoServerError):
            raise _no_answer(node) from None
        took = time.monotonic() - asked
        seen = len(beats)
        comes_true(lambda: len(beats) > seen + 1, LOOK_DURATION)  # the beat after a gap ends it
    finally:
        connection().node.destroy_subscription(subscription)
    return max(later - earlier for earlier, later in pairwise(beats)), took


def _no_answer(node: StudentNode) -> Exception:
    ended = comes_true(lambda: not node.is_running, EXIT_TIMEOUT)
    complaint = _complaint(node) if ended else ""
    advice = (
        "asyncio's event loop doesn't run here: await an rclpy Future"
        if "event loop" in complaint
        else "fix the error that is named here"
        if ended
        else "let a timer complete the future, and give the timer callback_group=self.waiting: "
        "the default group stays closed while look_around awaits"
    )
    return not_yet(f"no answer from look_around{complaint}", f"an answer after {LOOK_DURATION:g} s", advice)


def _expect_refusal(node: StudentNode, why: str) -> None:
    answer = _report(node, why)
    expect(
        not answer.success,
        seen=f"{why}, and the report says {answer.message!r}",
        expected="success=False",
        next="let ask() return None when the time is up: `await future` gives it to you",
    )


def _report(node: StudentNode, why: str) -> Any:
    try:
        return call("report", Trigger, timeout=REPORT_TIMEOUT)
    except (NoAnswerError, NoServerError):
        pass
    if comes_true(lambda: not node.is_running, EXIT_TIMEOUT):
        raise not_yet(f"no report{_complaint(node)}", "a report", "fix the error that is named here")
    raise not_yet(
        f"{why}, and no report within {REPORT_TIMEOUT:g} s; the node still runs",
        "a report within 1 s or so",
        "let a timer call future.cancel after `seconds`, and give the timer callback_group=self.asking: "
        "the default group stays closed while on_request awaits",
    )


@contextmanager
def _where_am_i() -> Iterator[None]:
    """Play the server that knows the position."""

    def answer(_: Any, response: Any) -> Any:
        response.success, response.message = True, POSITION
        return response

    service = connection().node.create_service(Trigger, "where_am_i", answer)
    try:
        yield
    finally:
        connection().node.destroy_service(service)


def _complaint(node: StudentNode) -> str:
    """Return the last error in the log of a node that has ended, to put behind what was seen."""
    return (
        "" if node.is_running else f"; the node has ended: {last_error_or_line(node.log(), node.file.name)}"
    )


GAPS = (
    Gap("two_groups.py", heart_beats_beside_the_sleep),
    Gap("awaiting.py", waits_without_a_thread),
    Gap("report_fixed.py", reports_or_says_why_not),
)
