"""What only the instructor's grading checks."""

from __future__ import annotations

from random import Random
from typing import Any

from autograder.authoring import standard_hidden
from autograder.authoring.checks import RESTING, Scenario
from autograder.authoring.obligation import check_of

from . import model
from .checks import (
    UNPLUGGED,
    UNPLUGGED_ROBOT,
    answers_with_the_last_message,
    follows_the_battery,
    says_when_it_knows_nothing,
    server_appears,
)


def _steps(random: Random) -> dict[str, Any]:
    """Ask before the first message, then in any order: at levels, in silences, many at once, while it changes."""

    def level() -> float:
        return round(random.uniform(0.0, 1.0), 4)

    blocks: list[list[list[Any]]] = [
        [["set_battery", level()], ["let_publish", 1], ["ask", 1]],
        [["set_battery", level()], ["ask", 1], ["let_publish", 2], ["ask", 2]],
        [["unplug"], ["wait", round(random.uniform(2.0, 6.0), 1)], ["ask", 2], ["plug_in"]],
        [
            ["unplug"],
            ["set_battery", level()],
            ["wait", round(random.uniform(11.0, 15.0), 1)],
            ["ask", 1],
            ["plug_in"],
        ],
        [["measure_charge", False], ["let_publish", 1], ["ask", 1], ["measure_charge", True]],
        [["let_publish", 1], ["ask", 8]],
    ]
    random.shuffle(blocks)
    before = [["ask", 1], ["wait", round(random.uniform(1.0, 6.0), 1)], ["ask", random.randint(2, 4)]]
    first = [["plug_in"], ["let_publish", 1], ["ask", 1]]
    return {"steps": [*before, *first, *(step for block in blocks for step in block)]}


ANY_ORDER = Scenario("in_order", _steps, robot=UNPLUGGED_ROBOT)
OTHER_NAMESPACE = Scenario(
    "in_order", {"steps": [["let_publish", 1], ["ask", 1]]}, robot=RESTING, namespace="/lab_7/robot"
)

recovers_when_the_sensor_appears = check_of(
    "recovers_when_the_sensor_appears",
    model.repeats_the_last_message,
    title="Once the first message has come, it answers with it",
    points=1,
    on=UNPLUGGED,
    needs=[answers_with_the_last_message, says_when_it_knows_nothing],
    see="02_services#m9-fix-why",
)

keeps_the_last_message = check_of(
    "keeps_the_last_message",
    model.repeats_the_last_message,
    model.says_when_it_knows_nothing,
    title="Whatever came before, and however long the sensor is silent, it answers with the last message",
    points=1,
    on=ANY_ORDER,
    needs=follows_the_battery,
    see="02_services#battery-rules",
)

answers_every_request = check_of(
    "answers_every_request",
    model.answers_in_time,
    model.never_waits,
    title="Every request is answered from memory, also eight at once",
    points=1,
    on=ANY_ORDER,
    needs=server_appears,
    see="02_services#m4-why",
)

works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "serves the robot",
    model.repeats_the_last_message,
    points=1,
    on=OTHER_NAMESPACE,
    needs=answers_with_the_last_message,
    clauses=[5],
)
