"""What really happened to every goal of fetch: its children, its battery, and when each was over."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any

from autograder.authoring import Goal, ScriptedCancel, ScriptedGoal, Transcript, ev, goals, unseen
from autograder.authoring.walking.planar import numbers_of

NAVIGATE, PICK, BATTERY = "navigate_to_pose", "pick_and_place", "battery_state"
TABLE, TAKE, HOME, PUT = "to the table", "take the object", "home", "put it down"
ACTION_OF = {TABLE: NAVIGATE, TAKE: PICK, HOME: NAVIGATE, PUT: PICK}
LOW = 0.20
EMPTY_HANDED = ("", "approaching", "grasping")  # stages; "" before the first feedback
SILENCE = 5.0  # s that a client waits
SLACK = 0.5  # s within which two things that happen may reach a program in either order


@dataclass(frozen=True, eq=False)
class Child:
    """A goal that the server sent to one of the two actions, and which of the four steps it is, by its place."""

    sent: ScriptedGoal
    step: str
    run: Transcript = field(repr=False)

    @property
    def action(self) -> str:
        """The action it was sent to."""
        return self.sent.received.action

    @property
    def t(self) -> float:
        """When it was sent (s)."""
        return self.sent.received.t

    @property
    def rejected(self) -> bool:
        """Whether its server rejected it."""
        return self.sent.reply is not None and not self.sent.reply.accepted

    @property
    def is_late(self) -> bool:
        """Whether its goal had no answer when 5 s were over, though it may have come later."""
        return self.sent.reply is None or self.sent.reply.t > self.t + SILENCE

    @property
    def began(self) -> float | None:
        """When it was accepted (s), None if it never was."""
        return self.sent.reply.t if self.sent.reply and self.sent.reply.accepted else None

    @cached_property
    def ended(self) -> float | None:
        """When it was over (s): it ended, it was rejected, or its server died. None: it never was."""
        died = [each for each in self.run.all(ev.ActionWithdrawn) if each.server == self.sent.received.server]
        over = [*died, self.sent.finished, self.sent.reply if self.rejected else None]
        return min((each.t for each in over if each), default=None)

    @property
    def is_dead(self) -> bool:
        """Whether it is over because its server died."""
        return self.ended is not None and self.sent.finished is None and not self.rejected

    @cached_property
    def received(self) -> list[float]:
        """When something was heard of it (s): its acceptance, and its feedback."""
        began = self.began
        return [] if began is None else [began, *(each.t for each in self.sent.feedback if each.t > began)]

    @cached_property
    def silent_at(self) -> float | None:
        """When nothing had been heard of it for 5 s (s), None if that never was so."""
        until = self.sent.finished.t if self.sent.finished else self.run.end
        for last, following in pairwise([*self.received, until]):
            if following - last > SILENCE:
                return last + SILENCE
        return None

    @property
    def is_silent_after_a_cancel(self) -> bool:
        """Whether it fell silent when the server had already asked to cancel it for another reason."""
        silent = self.silent_at
        return silent is not None and any(each.received.t < silent - SLACK for each in self.cancels())

    def stage(self, t: float) -> str:
        """Return the stage that its last feedback before a time (s) named, '' before the first and for a walk."""
        if self.action == NAVIGATE:
            return ""
        return next((each.feedback.stage for each in reversed(self.sent.feedback) if each.t < t), "")

    def is_empty_handed(self, t: float) -> bool:
        """Return whether a low battery cancels it at a time (s)."""
        return self.step != HOME and self.stage(t) in EMPTY_HANDED

    def cancels(self) -> Sequence[ScriptedCancel]:
        """Return the requests to cancel it while it was not over."""
        return [each for each in self.sent.cancels if self.ended is None or each.received.t < self.ended]


@dataclass(frozen=True, eq=False)
class Fetch:
    """A goal of fetch that must be accepted, with its children in order.

    `newer` is the goal that came while it was active. It had `begun` (s) when it was sent, or the one before it ended.
    """

    goal: Goal
    children: Sequence[Child]
    newer: Goal | None
    begun: float
    run: Transcript = field(repr=False)

    @property
    def canceled_at(self) -> float | None:
        """When its client asked to cancel it (s), while it was active."""
        end = self.goal.result.t if self.goal.result else math.inf
        asked = [each.sent.t for each in self.goal.cancels]
        return min((t for t in asked if self.goal.sent.t <= t < end), default=None)

    @property
    def preempted_at(self) -> float | None:
        """When a newer goal was sent (s)."""
        return self.newer.sent.t if self.newer else None

    @property
    def low_at(self) -> float | None:
        """When the battery first got low after it had begun (s)."""
        levels = (each for each in levels_of(self.run) if each.t > self.begun)
        return next((each.t for each in levels if is_low(each)), None)

    @property
    def stopped_at(self) -> float:
        """When its client canceled it, or a newer goal came (s), infinity if neither was so."""
        return min(each for each in (self.canceled_at, self.preempted_at, math.inf) if each is not None)

    def level(self, t: float) -> ev.MessagePublished | None:
        """Return the battery's last level before a time (s)."""
        return next((each for each in reversed(levels_of(self.run)) if each.t <= t), None)


def levels_of(run: Transcript) -> list[ev.MessagePublished]:
    """Return the messages of the battery that hold a percentage from 0 to 1."""
    return [each for each in run.published(BATTERY) if 0.0 <= each.message.percentage <= 1.0]


def is_low(level: ev.MessagePublished) -> bool:
    """Return whether a level of the battery is low."""
    return bool(level.message.percentage < LOW)


def is_offered(run: Transcript, action: str, since: float, until: float) -> bool:
    """Return whether a server of an action was there at any moment from `since` to `until` (s)."""
    there = {each.server for each in run.all(ev.ActionOffered) if each.action == action and each.t <= until}
    return bool(there - {each.server for each in run.all(ev.ActionWithdrawn) if each.t <= since})


def objection(request: Any) -> str:
    """Return why a goal of fetch must be rejected, '' if it must be accepted."""
    pose, force = request.place_pose.pose, request.grasp_force
    if (frame := request.place_pose.header.frame_id) != "odom":
        return f"its place_pose is in frame {frame!r}, and not in odom"
    for name, number in numbers_of(pose).items():
        if not math.isfinite(number):
            return f"{name} of its place_pose is {number:g}"
    return "" if math.isfinite(force) and force > 0 else f"nothing can be held with {force:g} N"


def fetches(run: Transcript) -> list[Fetch]:
    """Occasions: every goal of fetch that must be accepted."""
    _require_whole_lives(run)
    wanted = [goal for goal in goals(run) if not objection(goal.request)]
    sent = sorted(
        [*run.scripted_goals(NAVIGATE), *run.scripted_goals(PICK)], key=lambda each: each.received.t
    )
    found: list[Fetch] = []
    for number, goal in enumerate(wanted):
        following = wanted[number + 1] if number + 1 < len(wanted) else None
        until = following.sent.t if following else math.inf
        newer = following if following and (goal.result is None or until < goal.result.t) else None
        before = found[-1].goal.result if found and found[-1].newer else None
        own = [each for each in sent if goal.sent.t <= each.received.t < until]
        begun = max(goal.sent.t, before.t) if before else goal.sent.t
        found.append(Fetch(goal, _children(own, run), newer, begun, run))
    return found


def _require_whole_lives(run: Transcript) -> None:
    """Require that the record has the goal of each answer, the end of each result, and feedback that was passed on."""
    sent = {each.goal for each in run.all(ev.GoalReceived)}
    over = {each.goal for each in run.all(ev.GoalFinished)}
    answered = {each.goal for each in run.all(ev.GoalReplySent)} | over
    answered |= {each.goal for each in run.all(ev.FeedbackSent)}
    if lost := answered - sent:
        raise unseen(run, f"the record lacks the goal “{min(lost)}”, which was answered")
    if lost := {each.goal for each in run.all(ev.ResultSent)} - over:
        raise unseen(run, f"the record lacks the end of the goal “{min(lost)}”, whose result was sent")
    passed_on = [each.t for goal in run.goals for each in goal.feedback]
    for each in run.scripted_goals(PICK):
        if not each.reply or not each.finished or each.feedback:
            continue
        if any(each.reply.t < t < each.finished.t for t in passed_on):
            raise unseen(run, f"the record lacks the feedback of the goal “{each.name}”")


def children(run: Transcript) -> list[tuple[Fetch, Child]]:
    """Occasions: every goal that the server sent, with that of fetch for which it was."""
    return [(fetch, child) for fetch in fetches(run) for child in fetch.children]


def _children(sent: Sequence[ScriptedGoal], run: Transcript) -> list[Child]:
    """Return goals with the steps they are, of which a walk that is not the first leads home."""
    found: list[Child] = []
    for each in sent:
        before = [child.step for child in found]
        walk, pick = (HOME if TABLE in before else TABLE), (PUT if HOME in before else TAKE)
        found.append(Child(each, walk if each.received.action == NAVIGATE else pick, run))
    return found
