"""Requires that the record contains all that the script of a client's scenario says: else it is no evidence."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import accumulate, repeat
from math import inf
from typing import Any

from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.scripted_goal import ScriptedGoal
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.sequence import STEPS

EVENT_DELAY = 1.0  # s that an event may come after its time


def require_record(run: Transcript, action: str) -> None:
    """Require that the record contains what the server (`params["server"]`) and the user (the steps) did."""
    script = run.params.get("server")
    offered = any(event.action == action for event in run.all(ev.ActionOffered))
    if offered != (script is not None):
        raise unseen(run, f"{action} was {'' if offered else 'not '}offered")
    withdrawn = run.first(ev.ActionWithdrawn)
    until = min(run.end, withdrawn.t if withdrawn else inf)
    for goal in run.scripted_goals(action)[:1]:
        for what, due in _lacking(run, goal, script or {}):
            if due + EVENT_DELAY < until:
                raise unseen(run, f"the record lacks {what}")
    received = {each.cancel for each in run.all(ev.CancelReceived)}
    if any(each.cancel not in received for each in run.all(ev.CancelReplySent)):
        raise unseen(run, "the record lacks a request to cancel that was answered")
    _require_acts(run)


def _lacking(run: Transcript, goal: ScriptedGoal, script: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    """Yield what the server should have done, and when (s), if it is not in the record."""
    accepted = script.get("accepted", True)
    if goal.reply is None:
        if accepted is not None:
            yield "the answer to the goal", goal.received.t + script.get("after", 0.0)
        return
    if goal.reply.accepted != accepted:
        yield "the answer that the script requires", -inf
    if not goal.is_accepted:
        return
    ends_after = script.get("ends_after", 0.0)
    if goal.finished is None and (goal.result_sent or ends_after is not None):
        yield "the goal's end", -inf if goal.result_sent else goal.reply.t + ends_after
    yield from _lacking_feedback(goal, script)
    yield from _lacking_result(run, goal, script)
    yield from _lacking_replies(goal, {"agreed": True, "ends_after": 0.5, **script.get("cancel", {})})


def _lacking_feedback(goal: ScriptedGoal, script: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    assert goal.reply is not None
    distances, every = script.get("distances", ()), script.get("every", 0.2)
    gaps = repeat(every) if isinstance(every, float) else every
    due = [goal.reply.t + 1.2 * t for t, _ in zip(accumulate(gaps, initial=0.0), distances, strict=False)]
    came = len([each for each in goal.feedback if each.t >= goal.reply.t])
    over = goal.finished.t if goal.finished else inf
    if came < len(due) and due[came] + EVENT_DELAY < over:
        yield "feedback", due[came]


def _lacking_result(
    run: Transcript, goal: ScriptedGoal, script: Mapping[str, Any]
) -> Iterator[tuple[str, float]]:
    after, asked = script.get("result_after", 0.0), goal.result_requested
    forgotten = run.first(ev.ResultForgotten)
    if goal.finished is None or goal.result_sent or asked is None or after is None:
        return
    if forgotten is None or asked.t < forgotten.t:
        yield "the result", max(goal.finished.t, asked.t) + after


def _lacking_replies(goal: ScriptedGoal, script: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    for cancel in goal.cancels:
        if cancel.reply is None and script["agreed"] is not None:
            yield "the answer to the cancel", cancel.received.t + script.get("after", 0.0)
        ends_after = script["ends_after"]
        if cancel.reply and cancel.reply.canceling and goal.finished is None and ends_after is not None:
            yield "the end of a goal that was cancelled", cancel.reply.t + ends_after


def _require_acts(run: Transcript) -> None:
    """Require that the record contains all lines and Ctrl-C of the steps that were done before the program's end."""
    exited = run.first(ev.NodeExited)
    over = exited.t if exited else run.end
    done = {mark.name for mark in run.all(ev.Mark) if mark.t < over}
    steps = enumerate(run.params.get(STEPS, ()), start=1)
    verbs = [verb for number, (verb, *_) in steps if f"step {number}" in done]
    typed, pressed = verbs.count("type") + verbs.count("end_input"), verbs.count("press_ctrl_c")
    if len(run.all(ev.NodeTyped)) < typed or len(run.all(ev.NodeSignalled)) < pressed:
        raise unseen(run, "the record lacks what was typed or pressed")
