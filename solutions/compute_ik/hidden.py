"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

import math
from random import Random
from typing import Any

from autograder.authoring import Scenario, check_of, in_order
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .two_link_arm import DEFAULT, TwoLinkArm

OTHER_FRAMES = ["", "/shoulder", "a/shoulder", "Shoulder", "shoulder ", "shoulder_link", "map"]
NOT_FINITE = [math.nan, math.inf, -math.inf]
INVALID_LENGTHS = [0.0, -0.25, math.nan]  # m
BURST = 8  # a service keeps its last 10 requests
AT_A_LIMIT = 0.002  # m from a limit of the reach: twice the margin in which the statement allows either code


def _anywhere(random: Random, arm: TwoLinkArm) -> list[Any]:
    """Draw a request for a point that an arm reaches; near either limit of its reach as often as in between."""
    part = random.choice([random.uniform(0.0, 0.05), random.uniform(0.0, 1.0), random.uniform(0.95, 1.0)])
    nearest, farthest = arm.nearest + AT_A_LIMIT, arm.farthest - AT_A_LIMIT
    return _at_distance(random, nearest + part * (farthest - nearest))


def _at_distance(random: Random, distance: float) -> list[Any]:
    """Draw a request [x, y, elbow_up] for a point at a distance (m) from the shoulder, more often ahead of it."""
    direction = random.uniform(-math.pi, math.pi) / random.choice([1.0, 2.5])
    x, y = distance * math.cos(direction), distance * math.sin(direction)
    return [round(x, 5), round(y, 5), random.random() < 0.5]


def _targets(random: Random) -> dict[str, Any]:
    """Draw requests, in any order.

    Their points cover the whole reach, both sides of each of its limits, other frames and other heights.
    """
    limits = [
        _at_distance(random, limit + away)
        for limit in (DEFAULT.nearest, DEFAULT.farthest)
        for away in (-AT_A_LIMIT, -AT_A_LIMIT, 0.0, AT_A_LIMIT, AT_A_LIMIT)
    ]
    beyond = [
        _at_distance(random, random.uniform(0.56, 5.0)),
        _at_distance(random, random.uniform(0.0, 0.04)),
    ]
    within = [_anywhere(random, DEFAULT) for _ in range(12)]
    frames = [[*_anywhere(random, DEFAULT), frame] for frame in OTHER_FRAMES]
    high = [[*_anywhere(random, DEFAULT), "shoulder", random.choice([-1.0, 0.3, 40.0])] for _ in range(3)]
    questions = [*limits, *beyond, *within, *frames, *high]
    random.shuffle(questions)
    burst = [_anywhere(random, DEFAULT) for _ in range(BURST)]
    return {"steps": [*(["ask", question] for question in questions), ["ask", *burst], ["ask", [0.4, 0.3]]]}


def _lengths(random: Random) -> dict[str, Any]:
    """Read the lengths; set one, the other, both, then a valid one together with an invalid one.

    Requests follow each of these steps.
    """
    names = list(DEFAULT.parameters)
    upper_arm, forearm, *_ = lengths = [[name, round(random.uniform(0.1, 0.6), 3)] for name in 3 * names]
    arm = DEFAULT.parameters

    def set_and_ask(verb: str, *lengths: list[Any]) -> list[list[Any]]:
        before = TwoLinkArm(*arm.values())
        arm.update(dict(lengths))
        after = TwoLinkArm(*arm.values())
        points = [_anywhere(random, each) for each in (after, after, after, before)]
        distances = [after.farthest - AT_A_LIMIT, after.farthest + AT_A_LIMIT, after.nearest + AT_A_LIMIT]
        distances += [after.nearest - AT_A_LIMIT, 0.5 * after.nearest] if after.nearest > AT_A_LIMIT else []
        limits = [_at_distance(random, distance) for distance in distances]
        return [[verb, *lengths], *(["ask", question] for question in [*points, *limits])]

    forearm_first = [["forearm_length", round(random.uniform(0.35, 0.6), 3)], ["upper_arm_length", 0.2]]
    blocks: list[list[Any]] = [
        *(["set", upper_arm], ["set", forearm], ["set", *lengths[2:4]]),
        *(["set_together", *lengths[4:]], ["set_together", *forearm_first]),
    ]
    random.shuffle(blocks)
    sets = [step for block in blocks for step in set_and_ask(*block)]
    good, bad = random.sample(names, 2)
    half_good = ["set_together", [good, round(0.7 * arm[good], 3)], [bad, random.choice(INVALID_LENGTHS)]]
    first = [["ask", _anywhere(random, DEFAULT)] for _ in range(2)]
    last = [["ask", _anywhere(random, TwoLinkArm(*arm.values()))] for _ in range(4)]
    return {"steps": [["get", *names], *first, *sets, half_good, *last]}


def _no_numbers(random: Random) -> dict[str, Any]:
    """Request NaN and infinite points among valid ones; set invalid and valid lengths, each with requests."""
    points = [
        *([bad, 0.3] for bad in NOT_FINITE),
        *([0.3, bad] for bad in NOT_FINITE),
        [math.nan, math.nan],
        [0.4, 0.3, False, "shoulder", math.nan],
        [math.nan, 0.3, True, "base_link"],
    ]
    random.shuffle(points)
    steps = [["ask", question] for bad in points for question in (bad, _anywhere(random, DEFAULT))]
    names = list(DEFAULT.parameters)
    for bad in INVALID_LENGTHS:
        steps += [["set", [random.choice(names), bad]], ["ask", [0.4, 0.3]], ["ask", [0.1, -0.1, True]]]
    steps.append(["set", *([name, 0.35] for name in names)])
    with_equal_lengths = [[0.2, 0.3], [0.0, 0.0], [0.4, 0.3], [-0.3, 0.3]]  # the shoulder is one of them
    return {"steps": [*steps, *(["ask", point] for point in with_equal_lengths)]}


ANY_TARGET = Scenario("in_order", _targets, robot=None)
ANY_LENGTH = Scenario("in_order", _lengths, robot=None)
NO_NUMBER = Scenario("in_order", _no_numbers, robot=None)
OTHER_NAMESPACE = in_order(["ask", [0.4, 0.3]], robot=None, namespace="/lab_7/robot")

reaches_any_point = check_of(
    [
        model.answers_every_call,
        model.answers_in_time,
        model.reaches_the_point,
        model.bends_the_elbow_as_asked,
        model.says_what_is_out_of_reach,
        model.refuses_other_frames,
    ],
    title="Responses are right all around the shoulder, up to both limits, in any frame, and for eight calls at once",
    points=2,
    on=ANY_TARGET,
    needs=[checks.bends_the_elbow_as_asked, checks.says_what_is_out_of_reach, checks.refuses_other_frames],
)

refuses_what_is_no_number = check_of(
    [model.answers_every_call, model.refuses_a_pose_that_is_not_finite, model.refuses_nothing_within_reach],
    title="Coordinates or lengths that are NaN or infinite get no SUCCESS, and the node goes on responding",
    on=NO_NUMBER,
    needs=checks.says_what_is_out_of_reach,
    see="02_services#nan",
)

declares_its_lengths = check_of(
    model.lengths_are_parameters,
    on=ANY_LENGTH,
    needs=checks.server_appears,
    to_its_end=False,  # a crash of the node in a later step does not matter
)

does_what_it_says_of_new_lengths = check_of(
    model.uses_the_lengths_it_accepted,
    on=ANY_LENGTH,
    needs=[checks.bends_the_elbow_as_asked, checks.says_what_is_out_of_reach, declares_its_lengths],
)

works_in_any_namespace = standard_hidden.works_in_any_namespace(
    *("serves", model.reaches_the_point), on=OTHER_NAMESPACE, needs=checks.reaches_the_point, clauses=[10]
)
