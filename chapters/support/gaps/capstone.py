"""Chapter 11: the capstone."""

from __future__ import annotations

import json
import time
from functools import partial

from chapters.support import harness
from humanoid_interfaces.action import WalkTo
from lab.client.goals import Goal, send_goal
from lab.client.outcomes import Outcome
from lab.client.waiting import comes_true
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_checks import asked, last_error, read_program
from lab.running.student_nodes import StudentNode, run_node, stop_nodes

LEGS = f"{harness.__path__[0]}/played_legs.py"
NOT_MET = "has not accepted the goal"  # what errand.py says when the child's answer did not come
TRIES = 4  # errands until parent and child have found each other
TO_BEGIN = 6.0  # s for the first feedback, or for an end
TO_GO_DOWN = 2.0  # s for a cancel to reach the child
A_MOMENT = (
    0.5  # s for the child to tell of a cancel that came just before the errand ended; less than CHILD_NEEDS
)
CHILD_NEEDS = 1.0  # s that the played legs go on after a cancel
PATIENCE = 2.0  # s, as errand.py has it
SLOW = 3.0  # s of work for a child that is only slow
TO_END = 4.0  # s for an end that is due
CHILD_WORK_TIME = 15.0  # s of work for a child that is to be stopped


def waits_for_the_end_of_its_child() -> str:
    """Let an errand end by itself, and cancel another one."""
    parent, legs = _start("careful_errand.py", "steady")
    _let_it_end(parent, legs)
    goal = _under_way(parent, CHILD_WORK_TIME)
    seen = len(_events(legs))
    asked = time.monotonic()
    goal.cancel()
    went_down = comes_true(
        lambda: _has_told(legs, seen, "cancel") or goal.is_over or not parent.is_running, TO_GO_DOWN
    )
    if not comes_true(lambda: _has_told(legs, seen, "cancel"), A_MOMENT):
        raise not_yet(
            f"the errand ended {_status(goal)}, and go_ahead goes on: nobody has cancelled its goal"
            if went_down
            else f"{TO_GO_DOWN:g} s after the cancel of the errand, go_ahead got none",
            "a cancel for go_ahead within a moment",
            "in every round, ask self.should_stop(goal_handle), and call child.cancel_goal_async() when it is true",
        )
    comes_true(lambda: goal.is_over or not parent.is_running, CHILD_NEEDS + TO_END)
    if goal.is_over and not _has_ended(legs, seen):
        raise not_yet(
            f"the errand ended {_status(goal)} before its child had ended{_complaint(parent)}",
            "the child's end, and then the errand's",
            "go on waiting until end.done(): the answer to a cancel only says that the child will try",
        )
    if not goal.is_over:
        raise not_yet(
            f"go_ahead has ended, and {TO_END:g} s later the errand is {goal.status}{_complaint(parent)}",
            "the errand's end",
            "leave the loop when end.done(): call wait and sleep inside it, and nothing that waits forever",
        )
    outcome = goal.result(show_feedback=False)
    expect(
        outcome.status == "CANCELED" and not _complaint(parent),
        seen=f"the errand ended {outcome.status}{_complaint(parent)}",
        expected="CANCELED, and no error",
        next="only wait here, and return: finish() makes the terminal call",
    )
    cancels = _events(legs)[seen:].count("cancel")
    expect(
        cancels == 1,
        seen=f"{cancels} requests to cancel at go_ahead",
        expected="one",
        next="remember that you have asked: go_ahead answers every request after the first with a refusal",
    )
    took = time.monotonic() - asked
    return f"it succeeded when nobody cancelled; cancelled, it waited {took:.1f} s for the end of its child"


def _let_it_end(parent: StudentNode, legs: StudentNode) -> None:
    """Require that an errand which nobody cancels succeeds."""
    goal = _under_way(parent, 1.5)
    comes_true(lambda: goal.is_over or not parent.is_running, 1.5 + TO_END)
    if not goal.is_over:
        raise not_yet(
            f"nobody cancelled, the child has ended, and the errand is {goal.status}{_complaint(parent)}",
            "SUCCEEDED",
            "leave the loop as soon as end.done() is true",
        )
    outcome = goal.result(show_feedback=False)
    if outcome.status != "SUCCEEDED" and _has_told(legs, 0, "cancel"):
        raise not_yet(
            f"nobody cancelled the errand, and go_ahead was cancelled; the errand ended {outcome.status}",
            "SUCCEEDED",
            "call child.cancel_goal_async() only if self.should_stop(goal_handle)",
        )
    expect(
        outcome.status == "SUCCEEDED",
        seen=f"nobody cancelled, and the errand ended {outcome.status}{_complaint(parent)}",
        expected="SUCCEEDED when its child has",
        next="mend what this error names"
        if _complaint(parent)
        and "NoneType" not in _complaint(parent)  # finish() had no answer of the child yet
        else "return only when end.done() is true, and end the goal nowhere in these lines",
    )


def gives_up_a_silent_child() -> str:
    """Run an errand with a slow child, with one that falls silent, and with one that dies."""
    parent, legs = _start("patient_errand.py", "steady")
    _has_patience(parent, legs)
    reason = _gives_up_the_mute()
    parent, legs = _start("patient_errand.py", "steady")
    goal = _under_way(parent, CHILD_WORK_TIME)
    legs.kill()
    outcome = _end_of(goal, parent, 2 * PATIENCE + TO_END, "the child was killed")
    _require_abort(outcome, parent)
    return f"it waited for a slow child, and gave up a mute one and a dead one: {reason!r}"


def _has_patience(parent: StudentNode, legs: StudentNode) -> None:
    """Require that a child which works for longer than PATIENCE, with feedback, comes to its end."""
    goal = _under_way(parent, SLOW)
    outcome = _end_of(goal, parent, SLOW + TO_END, "the child gives feedback and ends in time")
    expect(
        outcome.status == "SUCCEEDED" and not _has_told(legs, 0, "cancel"),
        seen=f"a child that works {SLOW:g} s, with feedback ten times a second: "
        f"the errand ended {outcome.status}{_complaint(parent)}",
        expected="SUCCEEDED",
        next="measure the silence, time.monotonic() - self.heard; a long walk is no dead one",
    )


def _gives_up_the_mute() -> str:
    """Require that a child which falls silent is cancelled, and awaited; return the reason that the client gets."""
    parent, legs = _start("patient_errand.py", "mute")
    goal = _under_way(parent, CHILD_WORK_TIME)
    comes_true(
        lambda: _has_told(legs, 0, "cancel") or goal.is_over or not parent.is_running,
        PATIENCE + TO_GO_DOWN + 2.0,
    )
    if not comes_true(lambda: _has_told(legs, 0, "cancel"), A_MOMENT):
        raise not_yet(
            f"a child fell silent; the errand ended {_status(goal)}, and nobody cancelled the child{_complaint(parent)}"
            if goal.is_over
            else f"a child has been silent for {PATIENCE + 2.0:g} s, and nobody cancelled it{_complaint(parent)}",
            f"a cancel after {PATIENCE:g} s",
            "call child.cancel_goal_async() before you end the errand: the child may still walk"
            if goal.is_over
            else "compare time.monotonic() - self.heard with PATIENCE in every round",
        )
    outcome = _end_of(goal, parent, PATIENCE + TO_END, "the silent child was cancelled")
    expect(
        _has_ended(legs, 0),
        seen=f"the errand ended {outcome.status} at once, and its child a second later{_complaint(parent)}",
        expected="the child's end first: this one is mute, and not dead",
        next="after the cancel, wait_for(end, PATIENCE)",
    )
    _require_abort(outcome, parent)
    return str(outcome.result.error_msg)


def _require_abort(outcome: Outcome, parent: StudentNode) -> None:
    expect(
        outcome.status == "ABORTED" and "event CANCELED" not in _complaint(parent),
        seen=f"the errand ended {outcome.status}{_complaint(parent)}",
        expected="ABORTED, by your own call",
        next="end it with goal_handle.abort(): nobody has cancelled it",
    )
    expect(
        "go_ahead" in outcome.result.error_msg,
        seen=f"ABORTED with error_msg {outcome.result.error_msg!r}{_complaint(parent)}",
        expected="a sentence that names go_ahead",
        next="call goal_handle.abort(), once, and return WalkTo.Result(error_msg=…): "
        "the client of errand knows no other name",
    )


def finds_the_way_out() -> str:
    """Ask for the way out of each step."""
    program = read_program("way_out.py")
    come, lift, carry, lower = program["STEPS"]
    empty = "the hand is empty: stop the legs, and nothing follows"
    cases: tuple[tuple[str, tuple[bool, list[str]], str], ...] = (
        (come, (True, []), empty),
        (lift, (True, [lower]), "the hand has the glass: stop the arm, and lower the glass"),
        (carry, (True, [lower]), "the hand has the glass: stop the legs, and lower the glass"),
        (lower, (False, []), "the glass is almost down: let the arm finish, and nothing follows"),
    )
    for step, wanted, reason in cases:
        got = asked(partial(program["way_out"], step), "way_out.py")
        is_pair = isinstance(got, tuple | list) and len(got) == 2 and isinstance(got[1], tuple | list)
        expect(
            is_pair,
            seen=f"{got!r} for {step!r}",
            expected=f"{wanted!r}",
            next="end each path with `return`, True or False, and a list of steps",
        )
        stop, then = got
        expect(
            (bool(stop), list(then)) == wanted,
            seen=f"{(stop, list(then))!r} for {step!r}",
            expected=f"{wanted!r}",
            next=reason,
        )
    return "a way out of each of the four steps"


def _start(file: str, how: str) -> tuple[StudentNode, StudentNode]:
    """Start the student's parent beside legs that are played."""
    stop_nodes()
    legs = run_node(LEGS, how)
    return run_node(file), legs


def _under_way(parent: StudentNode, seconds: float) -> Goal:
    """Send errands until the child of one is at work, and return that one."""
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = "base_link"
    goal.target_pose.pose.position.x = float(seconds)
    for _ in range(TRIES):
        sent = send_goal("errand", WalkTo, goal)
        comes_true(partial(_is_decided, sent, parent), TO_BEGIN)
        if sent.feedback and not sent.is_over:
            return sent
        if not (sent.is_over and NOT_MET in sent.result(show_feedback=False).result.error_msg):
            break
    if not sent.is_over:
        raise not_yet(
            f"no feedback of go_ahead; the errand is {sent.status}{_complaint(parent)}",
            "an errand under way",
            "look at server.log()",
        )
    raise not_yet(
        f"the errand ended {_status(sent)} while its child was at work{_complaint(parent)}",
        "an errand that waits for its child",
        "wait until end.done(), and end the goal nowhere before",
    )


def _is_decided(goal: Goal, parent: StudentNode) -> bool:
    """Whether the child of an errand is at work, or will not be."""
    return bool(goal.feedback) or goal.is_over or not parent.is_running


def _end_of(goal: Goal, parent: StudentNode, seconds: float, why: str) -> Outcome:
    comes_true(lambda: goal.is_over or not parent.is_running, seconds)
    if goal.is_over:
        return goal.result(show_feedback=False)
    raise not_yet(
        f"{why}, and {seconds:g} s later the errand is {goal.status}{_complaint(parent)}",
        "its end",
        "end the branch with a terminal call and `return WalkTo.Result(…)`; wait only with a limit, "
        "wait_for(end, PATIENCE)",
    )


def _events(legs: StudentNode) -> list[str]:
    """What the played legs have told so far."""
    return [json.loads(line)["what"] for line in legs.log().splitlines() if line.startswith("{")]


def _has_told(legs: StudentNode, since: int, what: str) -> bool:
    """Whether the legs have told this, after so many other events."""
    return what in _events(legs)[since:]


def _has_ended(legs: StudentNode, since: int) -> bool:
    """Whether the cancelled child has ended, or what it told of that is just on its way here."""
    return comes_true(lambda: _has_told(legs, since, "CANCELED"), CHILD_NEEDS / 2)


def _status(goal: Goal) -> str:
    return goal.result(show_feedback=False).status if goal.is_over and goal.accepted else goal.status


def _complaint(node: StudentNode) -> str:
    """Return the last error in a node's log, to put behind what was seen."""
    error = last_error(node.log(), node.file.name)
    return f"; its log says: {error}" if error else ""


GAPS = (
    Gap("careful_errand.py", waits_for_the_end_of_its_child),
    Gap("patient_errand.py", gives_up_a_silent_child),
    Gap("way_out.py", finds_the_way_out),
)
