"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

import math
from functools import partial
from random import Random
from typing import Any

from autograder.authoring import Scenario, check_of, program, shuffled
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .checks import without_robot
from .gains import ABOVE, HIGHEST, MIN_KP, NAMES, sound_gains

KP, KD = ("kp_pitch", "kp_roll"), ("kd_pitch", "kd_roll")
Steps = list[list[Any]]


def _bad_values(random: Random) -> list[dict[str, Any]]:
    """Draw values with each fault for which a value is rejected."""
    return [
        {random.choice(KP): round(random.uniform(0.0, 50.99), 2)},
        {random.choice(NAMES): -random.choice((0.001, round(random.uniform(0.5, 900.0), 2)))},
        *({name: value} for value in (math.nan, math.inf, -math.inf) for name in random.sample(NAMES, 2)),
        *({name: limit} for name, limit in ABOVE.items()),
        *({name: random.randint(60, 290)} for name in random.sample(NAMES, 2)),
    ]


def _refused_steps(random: Random) -> Steps:
    """Return steps that set each invalid value, alone or together with valid ones in any order."""
    steps: Steps = []
    for bad in random.sample(found := _bad_values(random), len(found)):
        sound = sound_gains(random)
        good = [{name: sound[name]} for name in random.sample(NAMES, 2) if name not in bad]
        places = random.sample([bad, *good], 1 + len(good))
        values = {name: value for one in places for name, value in one.items()}
        steps += [
            random.choice((["set_each", bad], ["set_each", values], ["set_together", values])),
            *random.choice(([], [["settle"]], [["ask"], ["settle"]])),
        ]
    return steps


def _steps(random: Random) -> dict[str, Any]:
    """Set valid and invalid gains in any order, slowly and quickly, up to both ends of the table; subscribe late."""
    one_by_one, row = sound_gains(random), [sound_gains(random) for _ in range(4)]
    same = random.choice(NAMES)
    lowest = {name: round(random.uniform(51.001, 60.0), 3) for name in KP} | dict.fromkeys(KD, 0.0)
    lowest["max_torque"] = round(random.uniform(0.1, 5.0), 3)
    far = random.choice(NAMES)
    bad = _refused_steps(random)
    half = len(bad) // 2
    blocks: list[Steps] = [
        [["set_together", sound_gains(random)], ["settle"], ["ask"]],
        [["set_each", one_by_one], ["settle"], ["set_each", {same: one_by_one[same]}], ["settle"]],
        [["set_each", lowest], ["settle"], ["ask"], ["set_together", HIGHEST], ["settle"]],
        [["set_each", {name: gains[name]}] for gains in row for name in random.sample(NAMES, 1)],
        [
            *(["settle"], ["set_together", {"kd_pitch": 41.0, "kp_roll": 340.0, "kp_pitch": MIN_KP}]),
            *(["settle"], ["ask"], ["set_each", {"kd_roll": 45.0}], ["settle"]),
        ],
        [["set_each", {far: HIGHEST[far] + round(random.uniform(0.5, 900.0), 1)}], ["settle"], ["ask"]],
        [["wait", round(random.uniform(3.0, 9.0), 1)], ["listen", "a robot in between"]],
        *([*part, ["settle"]] for part in (bad[:half], bad[half:])),
    ]
    first = [["describe"], ["ask"], ["settle"], ["listen", "the first robot"]]
    last = [["settle"], ["ask"], ["listen", "the last robot"]]
    return {"steps": [*first, *shuffled(random, blocks), *last], "started_with": STARTED_WITH}


def _any_push(random: Random) -> dict[str, Any]:
    """Draw gains that hold the robot upright, and the direction of a push (10 N·s in odom)."""
    heading = random.uniform(-math.pi, math.pi)
    push = ["push", 10.0 * math.cos(heading), 10.0 * math.sin(heading), 0.0]
    return {"steps": [["ask"], ["settle"], ["set_together", sound_gains(random)], ["settle"], push]}


def _bad_start(number: int, values: dict[str, str]) -> Scenario:
    """Return the scenario that starts the program with one of these values; `number` chooses which."""

    def draw(random: Random) -> dict[str, Any]:
        names = random.sample(list(values), len(values))
        return {"name": (name := names[number % len(names)]), "value": values[name]}

    return program("start_with", draw, timed=False)


STARTED_WITH = {"kp_roll": 333.0, "kd_pitch": 50.0}
ANY_ORDER = Scenario("in_order", _steps, robot=None, parameters=STARTED_WITH)
ANY_PUSH = Scenario("in_order", _any_push)
LIMITS = {name: str(limit) for name, limit in ABOVE.items()}
BAD_VALUES = [LIMITS, *(dict.fromkeys(NAMES, value) for value in (".nan", "300", "-2.0"))]
BAD_STARTS = [_bad_start(number, values) for number, values in enumerate(BAD_VALUES)]
OTHER_NAMESPACE = without_robot(
    *(["ask"], ["settle"], ["set_each", {"kd_roll": 45.0}], ["settle"]), namespace="/lab_7/robot"
)

in_any_order = partial(check_of, on=ANY_ORDER)
refuses_in_any_order = partial(in_any_order, needs=checks.refuses_bad_gains)

refuses_what_is_no_number = refuses_in_any_order(
    [model.refuses_no_numbers, model.gives_a_reason],
    title="NaN and infinity are rejected with a reason",
    see="02_services#nan",
)
refuses_integers = refuses_in_any_order(
    [model.takes_no_integer_for_a_double, model.gives_a_reason],
    title="An integer for a double is rejected with a reason",
    see="10_parameters_and_balance#int-why",
)
refuses_the_limit_itself = refuses_in_any_order(
    [model.refuses_limits, model.refuses_weak_gains, model.refuses_negative_gains, model.gives_a_reason],
    title="A kp of exactly 51 N·m/rad and a max_torque of 0 are rejected, too",
    see=checks.TWO_CALLBACKS,
)
leaves_nothing_behind = in_any_order(
    [
        model.publishes_nothing_for_rejected_sets,
        model.has_what_it_accepted,
        model.publishes_only_what_was_accepted,
        model.keeps_the_last,
    ],
    title="Rejected values appear neither in the parameters, nor on the topic, nor for a robot that subscribes later",
    needs=[checks.sets_all_or_none, checks.keeps_the_last_gains],
)
publishes_any_gains = in_any_order(
    [model.has_its_gains, model.accepts_the_table, model.publishes_them_in_time, model.one_message_each],
    title="All values within the table's limits are accepted; each set is published once, also if it changes nothing",
    points=2,
    needs=checks.publishes_once,
    see=checks.TWO_CALLBACKS,
)
refuses_every_bad_start = check_of(
    model.refuses_to_start,
    title="Started with 51.0, NaN, an integer or a negative gain, it exits with status 1 and a line that says why",
    points=2,
    on=BAD_STARTS,
    needs=checks.refuses_a_bad_start,
)
survives_any_push = check_of(
    [model.accepts_the_table, model.publishes_them_in_time, model.survives],
    title="With other gains the robot survives a push of 10 N·s from any side",
    on=ANY_PUSH,
    needs=checks.survives_a_push,
)
works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "publishes",
    model.publishes_them_in_time,
    on=OTHER_NAMESPACE,
    needs=checks.publishes_what_it_accepted,
    clauses=[15],
)
