"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

import math
from functools import partial
from random import Random
from typing import Any

from autograder.authoring import Scenario, check_of, rounded
from autograder.authoring.walking.server_checks import OTHER_NAMESPACE, impossible
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .checks import FAR, STAY_TIME

AFTERWARDS = 0.8  # s from a result to the next goal
Steps = list[list[Any]]


def _walks(random: Random) -> dict[str, Any]:
    """Walk to poses behind the robot, preempt goals one by one and by several at once, then let the robot fall.

    At the second pose, a server that publishes its velocity in odom's axes would walk in a wrong direction.
    """
    side = random.choice((-1, 1))
    yaw = side * random.uniform(3.0, 3.1)
    x, y = random.uniform(0.2, 0.3), random.uniform(-0.1, 0.1)
    beyond = (x + 0.35 * math.cos(yaw), y + 0.35 * math.sin(yaw), -side * random.uniform(3.0, 3.1))
    aside = (beyond[0], beyond[1] + random.choice((-0.2, 0.2)), beyond[2])
    onwards = (x + 0.95 * math.cos(yaw), y + 0.95 * math.sin(yaw), beyond[2])
    rejected = impossible(random)
    blocks: list[Steps] = [
        [
            *(["go", "first", *FAR, 0.0], ["walk_for", random.uniform(0.2, 0.8)]),
            *(["go", "second", *onwards, 0.0], ["walk_for", random.uniform(0.2, 0.8)]),
            *(["go", "third", *onwards, 0.0], ["end", "first"], ["end", "second"], ["arrive", "third"]),
        ],
        [
            ["go_together", ["one", *aside, 0.0], ["two", *beyond, 0.0], ["three", *aside, 0.0]],
            *(["arrive", "one"], ["arrive", "two"], ["arrive", "three"]),
        ],
        [
            *(["go_on", "canceled", *FAR], ["walk_for", random.uniform(0.2, 0.8)], ["cancel", "canceled"]),
            ["wait", checks.STOPPING_TIME],
            *(["go", "at once", *beyond, 0.0], ["go", "instead", *aside, 0.0]),
            *(["end", "canceled"], ["end", "at once"], ["arrive", "instead"]),
        ],
        [["go", "here", *beyond, 0.0], *rejected[4:], ["arrive", "here"]],
    ]
    random.shuffle(blocks)
    steps = [
        *(["go", "back", x, y, yaw, 0.0], *rejected[:4], ["arrive", "back"], ["wait", AFTERWARDS]),
        *(["go", "across pi", *beyond, 0.0], ["arrive", "across pi"], ["wait", AFTERWARDS]),
        *(step for block in blocks for step in [*block, ["wait", AFTERWARDS]]),
        *(["go_on", "down", *FAR], ["walk_for", random.uniform(0.2, 0.8)], ["cut_power"], ["end", "down"]),
        *(["wait", AFTERWARDS], ["go", "lying", 0.0, 0.0, 0.0]),
        *(["set_up"], ["go", "up again", *beyond, 0.0], ["arrive", "up again"]),
    ]
    return {"steps": rounded(steps)}


def _phases(random: Random) -> dict[str, Any]:
    """Cancel in mid-stride at three different phases of the gait."""
    steps: Steps = []
    for k in range(3):
        delay = round(0.5 + 0.15 * k + random.uniform(0.0, 0.13), 3)
        name = f"after {delay:g} s"
        steps += [["go_on", name, *FAR], ["walk_for", delay], ["cancel", name], ["end", name]]
        steps += [["wait", STAY_TIME]]
    return {"steps": steps}


def _cancels(random: Random) -> dict[str, Any]:
    """Cancel, in any order: before acceptance, at the first feedback, twice, all goals, near arrival, after the end.

    At the end the motors are switched off when the robot has stopped near its goal.
    """
    ahead, side = random.uniform(0.5, 0.6), random.choice((-1, 1))

    def walking(name: str, *cancel: Any) -> Steps:
        return [
            *(["go_on", name, *FAR], ["walk_for", random.uniform(0.0, 0.8)]),
            *(list(cancel), ["end", name], ["wait", STAY_TIME]),
        ]

    blocks: list[Steps] = [
        [["cancel_at_once", "at once", *FAR], ["end", "at once"], ["wait", AFTERWARDS]],
        [
            *(["go_on", "first feedback", *FAR], ["hear_of", "first feedback"], ["cancel", "first feedback"]),
            *(["end", "first feedback"], ["wait", STAY_TIME]),
        ],
        walking("twice", "cancel_twice", "twice"),
        walking("stranger", "cancel_all"),
        [
            *(["go_on", "near", ahead, 0.0, 0.0], ["come_near", "near", random.uniform(0.12, 0.2)]),
            *(["cancel", "near"], ["end", "near"], ["wait", STAY_TIME]),
        ],
        [
            *(["go_on", "settled", 0.25, 0.0, 0.0], ["settle", "settled"], ["cancel", "settled"]),
            ["end", "settled"],
            *(["wait", AFTERWARDS], ["go_on", "after that", 0.25, 0.0, 0.0], ["arrive", "after that"]),
            ["wait", AFTERWARDS],
        ],
        [
            *(["go_on", "arrived", random.uniform(-0.2, -0.15), 0.0, 0.0], ["arrive", "arrived"]),
            *(["wait", AFTERWARDS], ["cancel", "arrived"]),
            *(["go_on", "after it", 0.2, 0.0, side * 1.5], ["arrive", "after it"], ["wait", AFTERWARDS]),
            *(["go_on", "aside", 0.0, side * 0.2, 0.0], ["arrive", "aside"], ["wait", AFTERWARDS]),
        ],
    ]
    random.shuffle(blocks)
    down: Steps = [
        *(["go_on", "down", 0.25, 0.0, 0.0], ["settle", "down"], ["cut_power"], ["end", "down"]),
        ["wait", AFTERWARDS],
    ]
    return {"steps": rounded([*(step for block in blocks for step in block), *down])}


ANY_ORDER = Scenario("in_order", _walks)
SEVERAL_PHASES = Scenario("in_order", _phases)
CANCELS = Scenario("in_order", _cancels)

of_cancels = partial(check_of, on=CANCELS)
arrives_anywhere = check_of(
    [
        model.accepts,
        model.rejects_frames,
        model.rejects_nan,
        model.rejects_without_power,
        model.goes_on,
        model.succeeds,
        model.turns_the_short_way,
        model.status_in_order,
        model.stands_at_success,
        model.stands_without_a_goal,
        model.feedback_at_5_hz,
        model.feedback_is_true,
        model.reports_where_it_ended,
        model.says_why_it_aborted,
        model.grants_cancels,
        model.answers_every_cancel,
        model.gives_way,
        model.only_one_is_newest,
        model.tells_a_fall,
    ],
    title="It reaches several poses with any heading, with other requests meanwhile, and fulfils every clause",
    points=2,
    on=ANY_ORDER,
    needs=checks.arrives,
    see="01_robot_and_graph#frames-intro",
)
cancels_at_the_start = of_cancels(
    model.canceled_at_the_start,
    title="A cancel before execution or at the first feedback ends CANCELED, with the robot still",
    needs=checks.cancels_in_mid_stride,
    see="07_cancel_and_preempt#m1-why",
)
stops_in_any_phase_of_the_gait = check_of(
    [model.grants_cancels, model.stops_when_canceled, model.stands_without_a_goal],
    title="The robot stops upright, whatever phase of its step it is in when the cancel comes",
    points=2,
    on=SEVERAL_PHASES,
    needs=checks.stops_when_canceled,
)
cancels_near_arrival = of_cancels(
    model.canceled_near_arrival,
    title="A cancel just before arrival ends CANCELED or SUCCEEDED, with the robot still",
    needs=checks.stops_when_canceled,
    see="07_cancel_and_preempt#fix-read",
)
survives_a_cancel_after_the_end = of_cancels(
    [
        model.refuses_late_cancels,
        model.accepts,
        model.succeeds,
        model.stands_at_success,
        model.stands_without_a_goal,
        model.status_in_order,
        model.feedback_is_true,
        model.reports_where_it_ended,
        model.tells_a_fall,
    ],
    title="A cancel at or after the goal's end has no effect: the robot walks to the next goal, and reports are right",
    needs=checks.arrives,
)
survives_two_cancels = of_cancels(
    [*model.canceled_twice, model.answers_every_cancel, model.feedback_ends_with_the_goal],
    title="Two cancel requests for one goal both get a response, and the goal ends CANCELED once",
    needs=checks.cancels_in_mid_stride,
    see="07_cancel_and_preempt#m12-why",
)
obeys_a_stranger = of_cancels(
    model.canceled_by_a_stranger,
    title="Another client can cancel all goals",
    needs=checks.stops_when_canceled,
    see="07_cancel_and_preempt#conventions",
)
works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "walks the robot", model.succeeds, clauses=[13], on=OTHER_NAMESPACE, needs=checks.arrives
)
