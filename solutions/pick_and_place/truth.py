"""Where hand and cup were, from the simulator's reports that the scenario requested."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Sequence
from typing import NamedTuple, TypeVar

from geometry_msgs.msg import Point

from autograder.authoring import Goal, RobotRecord, ev

LIFTED = 0.02  # m above where the cup stood; it no longer touches the table

E = TypeVar("E", ev.HandTruth, ev.ObjectTruth, ev.JointsTruth)


class Grip(NamedTuple):
    """A hand and the cup at one time.

    Attributes:
        t: s.
        hand, cup: (x, y, z) m in odom.
        force: N, of the pad that presses less.
        strongest: N, of the pad that presses more.
        opening: m between the pads.
    """

    t: float
    hand: Sequence[float]
    cup: Sequence[float]
    force: float
    strongest: float
    opening: float

    @property
    def distance(self) -> float:
        """Distance of the hand from the cup, m."""
        return math.dist(self.hand, self.cup)


def reports(run: RobotRecord, kind: type[E], start: float, end: float) -> Sequence[E]:
    """Return the simulator's reports of one kind from `start` to `end` (s); they must cover the whole time."""
    return run.reported(kind, start, end, of="hand and cup")


def cup_at(run: RobotRecord, t: float) -> ev.ObjectTruth:
    """Return the cup at a time (s): the last report up to then, or the first of all."""
    return reports(run, ev.ObjectTruth, t, t)[-1]


def grip_at(run: RobotRecord, t: float) -> Grip:
    """Return hand and cup at a time (s)."""
    return grips(run, t, t)[-1]


def grips(run: RobotRecord, start: float, end: float) -> list[Grip]:
    """Return hand and cup from `start` to `end` (s)."""
    hands, cups = reports(run, ev.HandTruth, start, end), reports(run, ev.ObjectTruth, start, end)
    times = [cup.t for cup in cups]
    return [
        Grip(
            t=hand.t,
            hand=hand.position,
            cup=cups[min(bisect_left(times, hand.t), len(cups) - 1)].position,
            force=min(hand.forces),
            strongest=max(hand.forces),
            opening=hand.opening,
        )
        for hand in hands
    ]


def carried(goal: Goal, until: float) -> list[Grip]:
    """Return hand and cup while the cup was off the table, from the goal's acceptance to `until` (s)."""
    height = max(cup_at(goal.run, goal.accepted_at).position[2], place_of(goal)[2]) + LIFTED
    return [grip for grip in grips(goal.run, goal.accepted_at, until) if grip.cup[2] > height]


def taken_from(goal: Goal) -> Sequence[float]:
    """Return where the cup stood when the goal was sent, m in odom."""
    return cup_at(goal.run, goal.sent.t).position


def place_of(goal: Goal) -> tuple[float, float, float]:
    """Return where the goal wants the cup, m in odom."""
    return as_tuple(goal.request.place_pose.pose.position)


def as_tuple(position: Point) -> tuple[float, float, float]:
    """Return (x, y, z) of a position."""
    return position.x, position.y, position.z
