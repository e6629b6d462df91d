"""Why a program gives no answer: a callback waits inside a callback, or no thread runs the callbacks."""

from __future__ import annotations

from autograder.authoring.diagnosis.exit_diagnosis import Remedy
from autograder.authoring.diagnosis.stack_location import where_it_waited, why_nobody_serves
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record

SPIN_LESSON = "02_services#first-intro"
DEADLOCK_LESSON = "02_services#m4-why"
AWAIT_LESSON = "05_executors#report-why"
_WAITS = (
    "A callback may not wait, sleep or call another service while the node has only one thread: no other callback "
    "runs meanwhile."
)
_AWAITS = (
    "No thread was blocked, so a callback awaits something that never completes. Meanwhile it keeps its callback "
    "group: give the client or timer that completes the await a ReentrantCallbackGroup or a group of its own, "
    "and the await a timeout."
)


def remedy_for_no_answer(run: Record) -> Remedy:
    """Return what to do about a program that gives no answer, by the line in which it was blocked."""
    if place := where_it_waited(run):
        return Remedy(f"It was blocked in {place}. {_WAITS}", DEADLOCK_LESSON)
    if idle := why_nobody_serves(run):
        return Remedy(idle, SPIN_LESSON)
    return Remedy(_AWAITS, AWAIT_LESSON) if run.first(ev.NodeStack) else Remedy(_WAITS, DEADLOCK_LESSON)
