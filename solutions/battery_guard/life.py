"""What a battery guard has to do in one run: how and when it may exit, and when it has to cancel its goal."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import inf
from typing import ClassVar, NamedTuple

from autograder.authoring import Failure, ScriptedGoal, Transcript, ev, require_one_goal, steps_until, unseen
from autograder.authoring.walking.client_record import require_record
from autograder.authoring.walking.client_run import (
    CANCELED,
    DETECTION_TIME,
    EXIT_SLACK,
    EXIT_TIME,
    MIN_WAIT_TIME,
    NO_SERVER,
    ORDER_MARGIN,
    SILENCE_LIMIT,
    STATUS_HELP,
    Cause,
    ClientRun,
    End,
    by_status,
)
from humanoid_interfaces.msg import RobotState

NAVIGATE = "navigate_to_pose"
BATTERY = "battery_state"
ROBOT = "robot_state"
LIMIT = 0.20
AT_ONCE_TIME = 1.0  # s
DELIVERY_TIME = 1.0  # s after which a client has certainly received a message
GRACE = 1.0  # s added to a clause's limit for a request, as the machine may be busy
IS_LATCHED = (
    f"{BATTERY} was published once, before your program started. A subscription receives that message only with "
    "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)."
)
_WAIT_FOR_BATTERY = (
    f"Spin until {BATTERY} has a percentage from 0 to 1, at most 5 s, then print a line on stderr and return 1. A "
    "single spin is not enough, and ignored messages do not count."
)
_WAIT_FOR_SERVER = "Check server_is_ready() for at most 5 s, then print a line on stderr and return 1."
_WAIT_NO_LONGER = (
    "Wait at most 5 s for the result after the cancel, even if feedback still comes; then print a line and "
    "return 4."
)


class Low(NamedTuple):
    """A time span (s) with the percentage below the limit, the first level in it, and the subscriptions then."""

    since: float
    until: float
    level: float
    subscriptions: int


def is_percentage(level: float) -> bool:
    """Return whether a battery level is a valid percentage."""
    return 0.0 <= level <= 1.0


@dataclass(frozen=True)
class GuardLife(ClientRun):
    """One run of a guard, with the messages of battery and robot during it."""

    action: ClassVar[str] = NAVIGATE
    pose_field: ClassVar[str] = "pose"
    end_in_time: ClassVar[str] = (
        "Keep the last message of robot_state (durability transient local), and check it after each spin. Give each "
        "wait after the cancel a timeout of 5 s from its start, even if feedback still comes."
    )

    @cached_property
    def goal(self) -> ScriptedGoal | None:
        """The goal that it sent, or None."""
        return require_one_goal(self.run, NAVIGATE) if self.run.scripted_goals(NAVIGATE) else None

    @cached_property
    def levels(self) -> list[ev.MessagePublished]:
        """The valid percentages, in order; of those before its start only the last, which a latched topic keeps."""
        return [event for event in self._heard_on(BATTERY) if is_percentage(event.message.percentage)]

    @property
    def ignored(self) -> list[ev.MessagePublished]:
        """The battery messages without a valid percentage."""
        return [event for event in self._heard_on(BATTERY) if not is_percentage(event.message.percentage)]

    @cached_property
    def lows(self) -> list[Low]:
        """The times during which the last percentage was below the limit."""
        found: list[Low] = []
        ends = [*(event.t for event in self.levels[1:]), inf]
        for event, end in zip(self.levels, ends, strict=False):
            level = event.message.percentage
            if level >= LIMIT:
                continue
            if found and found[-1].until == event.t:
                found[-1] = found[-1]._replace(until=end)
            else:
                found.append(Low(event.t, end, level, event.subscriptions))
        return found

    def stands_from(self, t: float) -> float:
        """Return when (s), at `t` or later, robot_state is first STANDING, or infinity."""
        modes = [(event.t, event.message.mode) for event in self._heard_on(ROBOT)]
        found = (
            max(since, t)
            for (since, mode), (until, _) in pairwise([*modes, (inf, None)])
            if mode == RobotState.STANDING and until > t
        )
        return next(found, inf)

    def _heard_on(self, topic: str) -> list[ev.MessagePublished]:
        started = self.run.first(ev.NodeStarted)
        published = self.run.published(topic)
        before = [event for event in published if started and event.t <= started.t]
        return published[max(len(before) - 1, 0) :]

    @cached_property
    def called_off(self) -> float:
        """When (s) it first sent a cancel request because of the battery or Ctrl-C, or infinity."""
        asked = [cancel.received.t for cancel in self.goal.cancels] if self.goal else []
        why = min((cause.since for cause in self.reasons()), default=inf)
        return next((t for t in asked if t >= why), inf)

    @property
    def for_the_battery(self) -> bool:
        """Whether it had to cancel the goal because of the battery, not only because of Ctrl-C."""
        return any(cause.name == "battery" and cause.since <= self.called_off for cause in self.reasons())

    # -- what it has to do --------------------------------------------------------------------------------------------

    def causes(self) -> list[Cause]:
        """Return the reasons to cancel its goal, each for one request."""
        return [replace(cause, once=True) for cause in super().causes()]

    def reasons(self) -> Iterator[Cause]:
        """Yield the reasons to cancel its goal, except missing feedback; of several, only the first needs a request."""
        if self.goal is None or self.accepted == inf:
            return
        finished = self.goal.finished.t if self.goal.finished else inf
        over = min([finished, *(since - ORDER_MARGIN for since, _, _ in self.silences())])
        found = [
            ("battery", self._fell(low), max(low.since, self.accepted), min(low.until, over))
            for low in self.lows
            if low.until > self.goal.received.t - DELIVERY_TIME
        ]
        if self.interrupted < inf:
            found.append(("Ctrl-C", "you pressed Ctrl-C", self.interrupted, over))
        found.sort(key=lambda each: each[2])
        for name, because, since, until in found:
            latest = since + AT_ONCE_TIME + GRACE
            in_time = any(since <= cancel.received.t <= latest for cancel in self.goal.cancels)
            is_first = since == found[0][2]
            is_alone = not any(since < other[2] <= latest for other in found)
            owed = is_first and (in_time or (until > latest and is_alone))
            yield Cause(name, because, since, latest, owed, once=True)

    def _fell(self, low: Low) -> str:
        early = self.accepted - low.since
        said = f" {early:.1f} s before the goal was accepted" if early > 0.0 else ""
        return f"the battery fell to {low.level:.4g}{said}"

    def _without_a_goal(self) -> list[End]:
        found = [*self._missing_something(), *self._low_before()]
        exited = self.run.first(ev.NodeExited)
        if not found and exited and exited.returncode == CANCELED and self.levels:
            level = self.levels[-1].message.percentage
            raise Failure(
                expected=f"a goal, as the percentage is {level:.4g}, which is not below {LIMIT:.2f}",
                observed="exit status 4 without a goal",
                help=about_level(level),
                at=exited.t,
            )
        if not found:
            require_one_goal(self.run, NAVIGATE)  # raises, with the reason why no goal came
        return found

    def _missing_something(self) -> Iterator[End]:
        """Yield the ends of a program that may not have found a percentage, or a server, within its time."""
        started, offered = self.started, self.when(ev.ActionOffered)
        known = max(self.levels[0].t, started) if self.levels else inf
        for name, because, t, since, help in (
            ("no percentage", f"no valid percentage came on {BATTERY}", known, started, _WAIT_FOR_BATTERY),
            ("no server", f"there is no server of {NAVIGATE}", offered, known, _WAIT_FOR_SERVER),
        ):
            earliest = started + SILENCE_LIMIT - DETECTION_TIME
            if t > earliest:
                since = since if since < inf else started
                latest = since + SILENCE_LIMIT + EXIT_SLACK
                yield End(NO_SERVER, name, because, started + SILENCE_LIMIT, earliest, latest, help)

    def _low_before(self) -> Iterator[End]:
        """Yield the ends of a program that received a low battery level; it may still look for the server."""
        started = self.run.first(ev.NodeStarted)
        for low in self.lows:
            since = max(low.since, started.t if started else low.since)
            found = min(max(self.when(ev.ActionOffered), since), since + 2 * SILENCE_LIMIT)
            help = IS_LATCHED if len(self._heard_on(BATTERY)) == 1 else STATUS_HELP
            because = f"the battery was at {low.level:.4g} before the goal was sent"
            yield End(CANCELED, "low before", because, since, since, found + DETECTION_TIME + EXIT_TIME, help)

    def _after_the_acceptance(self) -> Iterator[tuple[End, bool]]:
        """Yield each possible end after an accepted goal, and whether it is certain."""
        assert self.goal is not None
        called_off, finished, result = self.called_off, self.goal.finished, self.result
        for end, is_certain in self._in_silence():
            yield end, is_certain and end.at < called_off
        waits_until = inf  # until when it may wait
        if called_off < inf:
            by_keyboard = not self.for_the_battery
            over = called_off + SILENCE_LIMIT
            waits_until = max(over, min(self.stands_from(called_off), over + SILENCE_LIMIT))
            earliest = called_off + (MIN_WAIT_TIME if by_keyboard else SILENCE_LIMIT - ORDER_MARGIN)
            is_refused = any(cancel.reply and not cancel.reply.canceling for cancel in self.goal.cancels)
            may_go_on = is_refused and not by_keyboard
            because = f"the goal had no result {SILENCE_LIMIT:g} s after the cancel request"
            latest = waits_until + EXIT_SLACK
            yield (
                End(CANCELED, "no CANCELED", because, earliest, earliest, latest, _WAIT_NO_LONGER),
                waits_until == over and not may_go_on,
            )
            if may_go_on:
                waits_until = inf
        if finished and result < waits_until + ORDER_MARGIN:
            yield self._by_its_result(finished.status, called_off < result), True

    def _by_its_result(self, status: int, is_called_off: bool) -> End:
        """Return the end of a program that received the result; after a cancel it waits for STANDING, too."""
        t = self.result
        end = by_status(status, t)
        if end.status != CANCELED:
            return end
        stands = self.stands_from(t)
        name = "no STANDING" if is_called_off and stands > t + SILENCE_LIMIT else end.name
        latest = t + SILENCE_LIMIT + EXIT_SLACK  # it may wait this long for STANDING in any case
        earliest = end.earliest
        if is_called_off and self.for_the_battery:
            earliest = min(stands, t + SILENCE_LIMIT - ORDER_MARGIN)
            latest = min(stands + EXIT_SLACK, latest)
        return replace(end, name=name, earliest=earliest, latest=latest)

    def left_early(self, end: End, exited: ev.NodeExited) -> Failure:
        """Return the failure of a program that exited before it could know that this end was right."""
        if self.result > exited.t or end.status != CANCELED:
            return super().left_early(end, exited)
        return Failure(
            expected="the program to exit only when the goal is CANCELED and the robot stands",
            observed=f"it exited {exited.t - self.result:.1f} s after CANCELED, before robot_state was STANDING",
            help="CANCELED does not mean that the robot stands. Spin until the last mode in robot_state is "
            "RobotState.STANDING, at most 5 s. A STANDING from before the walk does not count.",
            at=exited.t,
        )


def guards(run: Transcript) -> list[GuardLife]:
    """Return the one run of the guard; the record must have every message that the scenario published."""
    require_record(run, NAVIGATE)
    before = {BATTERY: run.params["battery"] is not None, ROBOT: True}
    for topic, verb in ((BATTERY, "battery"), (ROBOT, "robot")):
        done = sum(step[0] == verb for step in steps_until(run, run.end))
        if len(run.published(topic)) < before[topic] + done:
            raise unseen(run, f"the record lacks what was published on {topic}")
    return [GuardLife(run)]


def about_level(level: float) -> str:
    """Return advice on a program that misinterprets this battery level."""
    if math.isnan(level):
        return (
            "NaN means that the level is unknown, neither low nor high: test for it with math.isnan(). For NaN "
            "`not percentage >= 0.20` is true."
        )
    if level > 1.0:
        return (
            "BatteryState.percentage is from 0 to 1, so a publisher with values up to 100 breaks the convention. Do "
            "not guess what it means (1.0 could be 1 % or 100 %): ignore the message, and log a warning."
        )
    if level < 0.0:
        return "A charge below 0 is invalid: ignore the message, and log a warning."
    if level == 0.0:
        return "0.0 is a valid percentage of an empty battery. Only NaN means that the level is unknown."
    return (
        "Compare the number unchanged: percentage < 0.20. As a float32, 0.20 is 0.200000003, which is not below the "
        "limit. Rounding or a tolerance would change the limit."
    )
