"""The turn to the goal, the walk and the turn to its heading: how the robot moves, and what status says of it."""

from __future__ import annotations

import re
from collections import Counter

from autograder.authoring import Goal, ev, expect, not_shown
from autograder.authoring.walking.life import phase
from autograder.authoring.walking.path import walking_speed

from .legs import Leg, off_the_way

FACING = 0.6  # rad between heading and goal while it walks
IN_PLACE = 0.10  # m/s of the body as a whole
# of the greatest speed, and turn rate in place, that the robot had on this leg
WALKS, STANDS, TURNS = 0.7, 0.4, 0.5

_NUMBER = re.compile(r"[-+]?\d+([.,]\d+)?")


def faces_its_way(goal: Goal) -> str | None:
    """It turns toward the goal, then walks straight ahead: it faces the goal in the middle of its way."""
    leg = Leg.of(goal)
    if leg is None:
        return None
    for robot in goal.run.robot_between(leg.half - 1.0, leg.half + 0.5):
        if walking_speed(goal.run, robot.t) < IN_PLACE:
            continue
        off = off_the_way(robot, goal)
        expect(
            off <= FACING,
            expected="the robot to turn toward the goal first, and to walk straight ahead",
            observed=f"it walks with its heading {off:.1f} rad off the goal",
            help="While the goal is farther than 0.3 m, publish angular.z alone until math.atan2(dy, dx) minus the "
            "heading is small; only then linear.x.",
            at=robot.t,
        )
    return phase(goal)


def names_its_phases(goal: Goal) -> str | None:
    """The walk has a status of its own, and the turns before and after it have others."""
    leg = Leg.of(goal)
    if leg is None:
        return None
    moves = [
        (robot, walking_speed(goal.run, robot.t))
        for robot in goal.run.robot_between(leg.start, leg.end)[::10]
    ]
    fastest = max(speed for _, speed in moves)
    in_place = min(IN_PLACE, STANDS * fastest)
    turn_rate = TURNS * max((abs(robot.turn_rate) for robot, speed in moves if speed < in_place), default=0.0)

    def turns(robot: ev.RobotTruth, speed: float) -> bool:
        return speed < in_place and abs(robot.turn_rate) > turn_rate

    turning = _statuses(goal, leg.start, leg.half, turns)
    walking = _statuses(goal, leg.start, leg.end, lambda robot, speed: speed > WALKS * fastest)
    aligning = _statuses(goal, leg.half, leg.end, turns)
    for what, statuses in (
        ("it turns toward the goal", turning),
        ("it walks", walking),
        ("it turns to the goal's heading", aligning),
    ):
        if not statuses:
            raise not_shown(goal.run, f"feedback comes while {what}")
        expect(
            all(status.strip() for status in statuses),
            expected=f"feedback.status to say in words that {what}",
            observed="an empty status",
            help="Keep the phase in a variable, change it where the loop changes what it does, and copy it to "
            "feedback.status.",
        )
    names = [statuses.most_common(1)[0][0] for statuses in (turning, walking, aligning)]
    expect(
        names[1] not in (names[0], names[2]),
        expected="a status of its own for the walk, and others for the turns before and after it",
        observed=f"{names[0]!r} as it turns, {names[1]!r} as it walks, {names[2]!r} as it turns to the heading",
        help="Set the phase where the loop decides to turn, to walk or to align, and send that.",
        at=leg.half,
    )
    return phase(goal)


def _statuses(goal: Goal, start: float, end: float, during) -> Counter[str]:
    """Count the statuses of the feedback, without the numbers in them, while the robot did something."""
    run = goal.run
    return Counter(
        _NUMBER.sub("", feedback.feedback.status)
        for feedback in goal.feedback
        if start < feedback.t < end and during(run.robot_at(feedback.t), walking_speed(run, feedback.t))
    )
