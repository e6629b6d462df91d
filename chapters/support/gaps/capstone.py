"""Chapter 11: the capstone."""

from __future__ import annotations

import json
import time
from functools import partial

from chapters.support import harness
from humanoid_interfaces.action import WalkTo
from lab.client.goals import Goal, send_goal
from lab.client.outcomes import Outcome
from lab.client.waiting import becomes_true
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import last_error, read_program, run_student_code
from lab.running.programs import run_program
from lab.running.student_nodes import StudentNode, run_node, stop_nodes

LEGS_PROGRAM = f"{harness.__path__[0]}/scripted_legs.py"
LASTING_CHILD_PROGRAM = f"{harness.__path__[0]}/lasting_child.py"
TRIAL_TIMEOUT = 30.0  # s; correct lines need 2 s
MAX_ROUNDS_PER_SECOND = 50  # the task asks for 20
MAX_CALLS_OF_DONE = 4  # in one round, by sound lines
NO_RESPONSE = "has not accepted the goal"  # errand.py's error_msg when the child sent no goal response
MAX_ERRANDS = 4  # goals sent until parent and child have discovered each other
FIRST_FEEDBACK_TIMEOUT = 6.0  # s until the errand gives feedback or ends
FORWARDED_CANCEL_TIMEOUT = 2.0  # s for a cancel to reach the child
REPORT_DELAY = 0.5  # s for a cancel to appear in the child's log; less than CHILD_CANCEL_DURATION
CHILD_CANCEL_DURATION = 1.0  # s that the scripted legs need to stop after a cancel
PATIENCE = 2.0  # s, the same as in errand.py
SLOW_WORK_TIME = 3.0  # s, for a child that is slow but gives feedback
END_TIMEOUT = 4.0  # s, beyond the expected duration
LONG_WORK_TIME = 15.0  # s, for a child that is stopped before it finishes


def waits_for_the_end_of_its_child() -> str:
    """Let one errand succeed, cancel another one, and give a third one a reason to stop without a cancel."""
    parent, legs = _start("careful_errand.py", "steady")
    _require_success(parent, legs)
    goal = _under_way(parent, LONG_WORK_TIME)
    seen = len(_events(legs))
    cancelled_at = time.monotonic()
    goal.cancel()
    has_reacted = becomes_true(
        lambda: _has_reported(legs, seen, "cancel") or goal.is_over or not parent.is_running,
        FORWARDED_CANCEL_TIMEOUT,
    )
    if not becomes_true(lambda: _has_reported(legs, seen, "cancel"), REPORT_DELAY):
        raise not_yet(
            f"the errand ended {_status(goal)}, but its child is still active: go_ahead received no cancel request"
            if has_reacted
            else f"the errand was cancelled, but go_ahead received no cancel request within "
            f"{FORWARDED_CANCEL_TIMEOUT:g} s",
            "a cancel request to go_ahead as soon as the errand is cancelled",
            "check self.should_stop(goal_handle) in every round, and call child.cancel_goal_async() when it is true",
        )
    becomes_true(lambda: goal.is_over or not parent.is_running, CHILD_CANCEL_DURATION + END_TIMEOUT)
    if goal.is_over and not _has_ended(legs, seen):
        raise not_yet(
            f"the errand ended {_status(goal)} before its child had ended{_error_in_log(parent)}",
            "the child ends first, then the errand",
            "keep waiting until end.done(): an accepted cancel only means that the child will try to stop",
        )
    if not goal.is_over:
        raise not_yet(
            f"{END_TIMEOUT:g} s after the child ended, the errand is still {goal.status}{_error_in_log(parent)}",
            "the errand ends soon after its child",
            "leave the loop when end.done() is true, and call nothing in the loop that waits without a limit",
        )
    outcome = goal.result(show_feedback=False)
    expect(
        outcome.status == "CANCELED" and not _error_in_log(parent),
        seen=f"the errand ended {outcome.status}{_error_in_log(parent)}",
        expected="CANCELED, and no error",
        next="only wait here, then return: finish() makes the terminal call",
    )
    cancels = _events(legs)[seen:].count("cancel")
    expect(
        cancels == 1,
        seen=f"go_ahead received {cancels} cancel requests for the same goal",
        expected="one cancel request",
        next="remember that you have sent one: go_ahead rejects every further cancel request",
    )
    took = time.monotonic() - cancelled_at
    _require_every_reason_and_pauses()
    return f"it succeeded without a cancel; after a cancel it waited {took:.1f} s until its child had ended"


def _require_every_reason_and_pauses() -> None:
    """Require that should_stop() alone decides on the cancel request, and that the loop sleeps between two rounds."""
    stop_nodes()
    trial = run_program(LASTING_CHILD_PROGRAM, timeout=TRIAL_TIMEOUT)
    printed = [line for line in trial.stdout.splitlines() if line.startswith("{")]
    error = last_error(trial.stderr, "careful_errand.py")
    expect(
        printed and not error,
        seen=f"wait_for_end() raised {error}" if error else "the trial of wait_for_end() printed nothing",
        expected="no exception",
        next="fix the error that is named here" if error else "run the cell again",
    )
    saw = json.loads(printed[0])
    expect(
        saw["cancels"],
        seen="self.should_stop(goal_handle) became true without a cancel of the goal, and go_ahead received no cancel "
        "request",
        expected="one cancel request to go_ahead",
        next="check self.should_stop(goal_handle), not goal_handle.is_cancel_requested: a newer goal or a low battery "
        "is a reason to stop, too",
    )
    expect(
        saw["cancels"] == ["cancel_goal_async"],
        seen=f"the calls: {', '.join(f'{method}()' for method in saw['cancels'])}",
        expected="one call of cancel_goal_async()",
        next="call child.cancel_goal_async(): cancel_goal() blocks until a response arrives, and a dead child sends "
        "none",
    )
    rate = max(saw["calls_of_should_stop"], saw["calls_of_done"] / MAX_CALLS_OF_DONE) / saw["seconds"]
    expect(
        rate <= MAX_ROUNDS_PER_SECOND,
        seen=f"the loop ran {rate:.0f} rounds a second",
        expected="about 20 rounds a second",
        next="call time.sleep(TICK) in each round: a loop without it takes a processor from all other threads",
    )


def _require_success(parent: StudentNode, legs: StudentNode) -> None:
    """Require that an errand succeeds if it is not cancelled."""
    goal = _under_way(parent, 1.5)
    becomes_true(lambda: goal.is_over or not parent.is_running, 1.5 + END_TIMEOUT)
    if not goal.is_over:
        raise not_yet(
            f"the errand was not cancelled and its child has ended, but the errand is still {goal.status}"
            f"{_error_in_log(parent)}",
            "SUCCEEDED",
            "leave the loop as soon as end.done() is true",
        )
    outcome = goal.result(show_feedback=False)
    if outcome.status != "SUCCEEDED" and _has_reported(legs, 0, "cancel"):
        raise not_yet(
            f"the errand was not cancelled, but it sent a cancel request to go_ahead and ended {outcome.status}",
            "SUCCEEDED",
            "call child.cancel_goal_async() only if self.should_stop(goal_handle)",
        )
    expect(
        outcome.status == "SUCCEEDED",
        seen=f"the errand was not cancelled, but it ended {outcome.status}{_error_in_log(parent)}",
        expected="SUCCEEDED after its child has SUCCEEDED",
        next="fix the error that is named here"
        if _error_in_log(parent)
        and "NoneType"
        not in _error_in_log(parent)  # otherwise finish() was called before the child's result arrived
        else "return only when end.done() is true, and make no terminal call in these lines",
    )


def gives_up_a_silent_child() -> str:
    """Run an errand with a slow child, with one that stops giving feedback, and with one that is killed."""
    print("a slow child …")
    parent, legs = _start("patient_errand.py", "steady")
    _require_patience(parent, legs)
    print("a silent child …")
    reason = _require_cancel_of_a_silent_child()
    print("a child that dies …")
    parent, legs = _start("patient_errand.py", "steady")
    goal = _under_way(parent, LONG_WORK_TIME)
    legs.kill()
    outcome = _end_of(goal, parent, 2 * PATIENCE + END_TIMEOUT, "the child was killed")
    _require_abort(outcome, parent)
    return f"it waited for a slow child, and gave up a silent one and a dead one: {reason!r}"


def _require_patience(parent: StudentNode, legs: StudentNode) -> None:
    """Require that the errand waits for a child that works longer than PATIENCE but gives feedback."""
    goal = _under_way(parent, SLOW_WORK_TIME)
    outcome = _end_of(goal, parent, SLOW_WORK_TIME + END_TIMEOUT, "the child gave feedback and succeeded")
    expect(
        outcome.status == "SUCCEEDED" and not _has_reported(legs, 0, "cancel"),
        seen=f"the child worked {SLOW_WORK_TIME:g} s and gave feedback ten times a second, "
        f"but the errand ended {outcome.status}{_error_in_log(parent)}",
        expected="SUCCEEDED",
        next="measure the time since the last feedback, time.monotonic() - self.heard: a long walk is no failure",
    )


def _require_cancel_of_a_silent_child() -> str:
    """Require that a child without feedback is cancelled and that the errand waits for its end.

    Return the error_msg that the client receives.
    """
    parent, legs = _start("patient_errand.py", "silent")
    goal = _under_way(parent, LONG_WORK_TIME)
    becomes_true(
        lambda: _has_reported(legs, 0, "cancel") or goal.is_over or not parent.is_running,
        PATIENCE + FORWARDED_CANCEL_TIMEOUT + 2.0,
    )
    if not becomes_true(lambda: _has_reported(legs, 0, "cancel"), REPORT_DELAY):
        raise not_yet(
            f"the child stopped giving feedback; the errand ended {_status(goal)} without a cancel request to the child"
            f"{_error_in_log(parent)}"
            if goal.is_over
            else f"the child has given no feedback for {PATIENCE + 2.0:g} s, but it received no cancel request"
            f"{_error_in_log(parent)}",
            f"a cancel request to the child after {PATIENCE:g} s without feedback",
            "call child.cancel_goal_async() before you end the errand: the child may still walk"
            if goal.is_over
            else "compare time.monotonic() - self.heard with PATIENCE in every round",
        )
    outcome = _end_of(goal, parent, PATIENCE + END_TIMEOUT, "the silent child was cancelled")
    expect(
        _has_ended(legs, 0),
        seen=f"the errand ended {outcome.status} at once, but its child ended a second later{_error_in_log(parent)}",
        expected="the child ends first: it gives no feedback, but it still responds to a cancel",
        next="call wait_for(end, PATIENCE) after the cancel request",
    )
    _require_abort(outcome, parent)
    return str(outcome.result.error_msg)


def _require_abort(outcome: Outcome, parent: StudentNode) -> None:
    expect(
        outcome.status == "ABORTED" and "event CANCELED" not in _error_in_log(parent),
        seen=f"the errand ended {outcome.status}{_error_in_log(parent)}",
        expected="ABORTED, by your own call of goal_handle.abort()",
        next="end it with goal_handle.abort(): the errand was not cancelled",
    )
    expect(
        "go_ahead" in outcome.result.error_msg,
        seen=f"ABORTED with error_msg {outcome.result.error_msg!r}{_error_in_log(parent)}",
        expected="an error_msg that names go_ahead",
        next="call goal_handle.abort() once, and return WalkTo.Result(error_msg=…) with the name go_ahead in it",
    )


def finds_the_way_out() -> str:
    """Call way_out() for each step."""
    program = read_program("way_out.py")
    come, lift, carry, lower = program["STEPS"]
    empty = "the hand is empty: stop the legs; no further step is needed"
    cases: tuple[tuple[str, tuple[bool, list[str]], str], ...] = (
        (come, (True, []), empty),
        (lift, (True, [lower]), "the hand has the glass: stop the arm, and lower the glass"),
        (carry, (True, [lower]), "the hand has the glass: stop the legs, and lower the glass"),
        (lower, (False, []), "the glass is almost down: let the arm finish; no further step is needed"),
    )
    for step, wanted, reason in cases:
        got = run_student_code(partial(program["way_out"], step), "way_out.py")
        is_pair = isinstance(got, tuple | list) and len(got) == 2 and isinstance(got[1], tuple | list)
        expect(
            is_pair,
            seen=f"way_out({step!r}) returned {got!r}",
            expected=f"{wanted!r}",
            next="end each path with `return` and a pair: True or False, and a list of steps",
        )
        stop, then = got
        expect(
            (bool(stop), list(then)) == wanted,
            seen=f"way_out({step!r}) returned {(stop, list(then))!r}",
            expected=f"{wanted!r}",
            next=reason,
        )
    return "the right way out of each of the four steps"


def _start(file: str, how: str) -> tuple[StudentNode, StudentNode]:
    """Start the student's errand server beside the scripted legs."""
    stop_nodes()
    legs = run_node(LEGS_PROGRAM, how)
    return run_node(file), legs


def _under_way(parent: StudentNode, seconds: float) -> Goal:
    """Send errands until the child of one of them gives feedback, and return that errand."""
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = "base_link"
    goal.target_pose.pose.position.x = float(seconds)
    for _ in range(MAX_ERRANDS):
        sent = send_goal("errand", WalkTo, goal)
        becomes_true(partial(_has_begun_or_ended, sent, parent), FIRST_FEEDBACK_TIMEOUT)
        if sent.feedback and not sent.is_over:
            return sent
        if not (sent.is_over and NO_RESPONSE in sent.result(show_feedback=False).result.error_msg):
            break
    if not sent.is_over:
        raise not_yet(
            f"go_ahead gave no feedback; the errand is {sent.status}{_error_in_log(parent)}",
            "feedback from go_ahead",
            "read the node's log: print(server.log())",
        )
    raise not_yet(
        f"the errand ended {_status(sent)} while its child was still active{_error_in_log(parent)}",
        "an errand that waits for its child",
        "wait until end.done() is true, and make no terminal call before that",
    )


def _has_begun_or_ended(goal: Goal, parent: StudentNode) -> bool:
    """Whether the child of an errand gives feedback, or never will."""
    return bool(goal.feedback) or goal.is_over or not parent.is_running


def _end_of(goal: Goal, parent: StudentNode, seconds: float, situation: str) -> Outcome:
    becomes_true(lambda: goal.is_over or not parent.is_running, seconds)
    if goal.is_over:
        return goal.result(show_feedback=False)
    raise not_yet(
        f"{situation}; {seconds:g} s later the errand is still {goal.status}{_error_in_log(parent)}",
        "an errand that has ended",
        "end the branch with a terminal call and `return WalkTo.Result(…)`; wait only with a limit, "
        "wait_for(end, PATIENCE)",
    )


def _events(legs: StudentNode) -> list[str]:
    """Return the events that the scripted legs have printed so far."""
    return [json.loads(line)["what"] for line in legs.log().splitlines() if line.startswith("{")]


def _has_reported(legs: StudentNode, since: int, what: str) -> bool:
    """Whether the legs have reported this event; the first `since` events do not count."""
    return what in _events(legs)[since:]


def _has_ended(legs: StudentNode, since: int) -> bool:
    """Whether the cancelled child has ended; waits a moment for its report."""
    return becomes_true(lambda: _has_reported(legs, since, "CANCELED"), CHILD_CANCEL_DURATION / 2)


def _status(goal: Goal) -> str:
    return goal.result(show_feedback=False).status if goal.is_over and goal.accepted else goal.status


def _error_in_log(node: StudentNode) -> str:
    """Return the last error in a node's log as the end of a `seen` sentence; "" without an error."""
    error = last_error(node.log(), node.file.name)
    return f"; the node's log says: {error}" if error else ""


GAPS = (
    Gap("careful_errand.py", waits_for_the_end_of_its_child),
    Gap("patient_errand.py", gives_up_a_silent_child),
    Gap("way_out.py", finds_the_way_out),
)
