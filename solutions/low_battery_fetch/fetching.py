"""What happened during every goal of fetch: its children, the battery level, and when each child ended."""

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
SILENCE = 5.0  # s for which a client waits
SLACK = 0.5  # s; two messages sent within this time may arrive in either order


@dataclass(frozen=True, eq=False)
class Child:
    """A goal that the server sent to one of the two actions, and which of the four steps it is, by its position."""

    sent: ScriptedGoal
    step: str
    run: Transcript = field(repr=False)

    @property
    def action(self) -> str:
        """The action to which it was sent."""
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
        """Whether it was neither accepted nor rejected within 5 s; that may have happened later."""
        return self.sent.reply is None or self.sent.reply.t > self.t + SILENCE

    @property
    def began(self) -> float | None:
        """When it was accepted (s), or None."""
        return self.sent.reply.t if self.sent.reply and self.sent.reply.accepted else None

    @cached_property
    def ended(self) -> float | None:
        """When it had a result, was rejected, or its server died (s), or None."""
        died = [each for each in self.run.all(ev.ActionWithdrawn) if each.server == self.sent.received.server]
        over = [*died, self.sent.finished, self.sent.reply if self.rejected else None]
        return min((each.t for each in over if each), default=None)

    @property
    def is_dead(self) -> bool:
        """Whether it ended because its server died."""
        return self.ended is not None and self.sent.finished is None and not self.rejected

    @cached_property
    def received(self) -> list[float]:
        """When its acceptance and its feedback were sent (s)."""
        began = self.began
        return [] if began is None else [began, *(each.t for each in self.sent.feedback if each.t > began)]

    @cached_property
    def silent_at(self) -> float | None:
        """When neither acceptance nor feedback had come for 5 s (s), or None."""
        until = self.sent.finished.t if self.sent.finished else self.run.end
        for last, following in pairwise([*self.received, until]):
            if following - last > SILENCE:
                return last + SILENCE
        return None

    @property
    def is_silent_after_a_cancel(self) -> bool:
        """Whether its feedback stopped after the server had already canceled it for another reason."""
        silent = self.silent_at
        return silent is not None and any(each.received.t < silent - SLACK for each in self.cancels())

    def stage(self, t: float) -> str:
        """Return the stage in its last feedback before a time (s); '' before the first feedback, and for a walk."""
        if self.action == NAVIGATE:
            return ""
        return next((each.feedback.stage for each in reversed(self.sent.feedback) if each.t < t), "")

    def is_empty_handed(self, t: float) -> bool:
        """Return whether the hand was empty at a time (s), so that a low battery cancels the child."""
        return self.step != HOME and self.stage(t) in EMPTY_HANDED

    def cancels(self) -> Sequence[ScriptedCancel]:
        """Return the cancel requests that came before it ended."""
        return [each for each in self.sent.cancels if self.ended is None or each.received.t < self.ended]


@dataclass(frozen=True, eq=False)
class Fetch:
    """A goal of fetch that must be accepted, with its children in order.

    `newer` is the goal that came while it was active. `begun` is when it was sent, or when the goal that it preempted
    ended (s).
    """

    goal: Goal
    children: Sequence[Child]
    newer: Goal | None
    begun: float
    run: Transcript = field(repr=False)

    @property
    def canceled_at(self) -> float | None:
        """When its client canceled it while it was active (s), or None."""
        end = self.goal.result.t if self.goal.result else math.inf
        asked = [each.sent.t for each in self.goal.cancels]
        return min((t for t in asked if self.goal.sent.t <= t < end), default=None)

    @property
    def preempted_at(self) -> float | None:
        """When a newer goal was sent (s), or None."""
        return self.newer.sent.t if self.newer else None

    @property
    def low_at(self) -> float | None:
        """When the battery first got low after it had begun (s), or None."""
        levels = (each for each in levels_of(self.run) if each.t > self.begun)
        return next((each.t for each in levels if is_low(each)), None)

    @property
    def stopped_at(self) -> float:
        """When its client canceled it or a newer goal came (s), or infinity."""
        return min(each for each in (self.canceled_at, self.preempted_at, math.inf) if each is not None)

    def level(self, t: float) -> ev.MessagePublished | None:
        """Return the battery's last level before a time (s)."""
        return next((each for each in reversed(levels_of(self.run)) if each.t <= t), None)


def levels_of(run: Transcript) -> list[ev.MessagePublished]:
    """Return the battery messages whose percentage is from 0 to 1."""
    return [each for each in run.published(BATTERY) if 0.0 <= each.message.percentage <= 1.0]


def is_low(level: ev.MessagePublished) -> bool:
    """Return whether a level of the battery is low."""
    return bool(level.message.percentage < LOW)


def is_offered(run: Transcript, action: str, since: float, until: float) -> bool:
    """Return whether a server of an action existed at any time from `since` to `until` (s)."""
    there = {each.server for each in run.all(ev.ActionOffered) if each.action == action and each.t <= until}
    return bool(there - {each.server for each in run.all(ev.ActionWithdrawn) if each.t <= since})


def objection(request: Any) -> str:
    """Return why a goal of fetch must be rejected, '' if it must be accepted."""
    pose, force = request.place_pose.pose, request.grasp_force
    if (frame := request.place_pose.header.frame_id) != "odom":
        return f"its place_pose is in frame {frame!r}, not in 'odom'"
    for name, number in numbers_of(pose).items():
        if not math.isfinite(number):
            return f"{name} of its place_pose is {number:g}"
    return "" if math.isfinite(force) and force > 0 else f"its grasp_force is {force:g} N"


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
    """Require that the record is complete.

    It must have the goal for each response, the end for each result, and the feedback that fetch published again.
    """
    sent = {each.goal for each in run.all(ev.GoalReceived)}
    over = {each.goal for each in run.all(ev.GoalFinished)}
    answered = {each.goal for each in run.all(ev.GoalReplySent)} | over
    answered |= {each.goal for each in run.all(ev.FeedbackSent)}
    if lost := answered - sent:
        raise unseen(run, f"the record lacks the goal “{min(lost)}”, to which there was a response")
    if lost := {each.goal for each in run.all(ev.ResultSent)} - over:
        raise unseen(run, f"the record lacks the end of the goal “{min(lost)}”, whose result was sent")
    passed_on = [each.t for goal in run.goals for each in goal.feedback]
    for each in run.scripted_goals(PICK):
        if not each.reply or not each.finished or each.feedback:
            continue
        if any(each.reply.t < t < each.finished.t for t in passed_on):
            raise unseen(run, f"the record lacks the feedback of the goal “{each.name}”")


def children(run: Transcript) -> list[tuple[Fetch, Child]]:
    """Occasions: every goal that the server sent, with the goal of fetch for which it was sent."""
    return [(fetch, child) for fetch in fetches(run) for child in fetch.children]


def _children(sent: Sequence[ScriptedGoal], run: Transcript) -> list[Child]:
    """Return goals with their steps; every walk after the first leads home."""
    found: list[Child] = []
    for each in sent:
        before = [child.step for child in found]
        walk, pick = (HOME if TABLE in before else TABLE), (PUT if HOME in before else TAKE)
        found.append(Child(each, walk if each.received.action == NAVIGATE else pick, run))
    return found
