"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from random import Random
from typing import Any

from autograder.authoring import Scenario, check_of, in_order, shuffled
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .checks import UNPLUGGED, UNPLUGGED_ROBOT


def _steps(random: Random) -> dict[str, Any]:
    """Call the service before the first message, then in any order: at various levels, in pauses, eight at once."""

    def level() -> float:
        return round(random.uniform(0.0, 1.0), 4)

    blocks: list[list[list[Any]]] = [
        [["set_battery", level()], ["let_publish", 1], ["ask", 1]],
        [["set_battery", level()], ["ask", 1], ["let_publish", 2], ["ask", 2]],
        [["unplug"], ["wait", round(random.uniform(2.0, 6.0), 1)], ["ask", 2], ["plug_in"]],
        [
            *(["unplug"], ["set_battery", level()], ["wait", round(random.uniform(11.0, 15.0), 1)]),
            *(["ask", 1], ["plug_in"]),
        ],
        [
            ["set_battery", 0.0],
            ["let_publish", 2],
            ["ask", 1],
        ],  # then only fields other than the charge change
        [["measure_charge", False], ["let_publish", 1], ["ask", 1], ["measure_charge", True]],
        [
            ["set_clock", -round(random.uniform(60.0, 4000.0))],
            ["let_publish", 1],
            ["ask", 2],
            ["set_clock", 0],
        ],
        [["let_publish", 1], ["ask", 8]],
    ]
    any_order = shuffled(random, blocks)
    before = [["ask", 1], ["wait", round(random.uniform(1.0, 6.0), 1)], ["ask", 8]]
    return {"steps": [*before, ["plug_in"], ["let_publish", 1], ["ask", 1], *any_order]}


ANY_ORDER = Scenario("in_order", _steps, robot=UNPLUGGED_ROBOT)
OTHER_NAMESPACE = in_order(["let_publish", 1], ["ask", 1], namespace="/lab_7/robot")

recovers_when_the_sensor_appears = check_of(
    model.repeats_the_last_message,
    title="After the first message it responds with that message",
    on=UNPLUGGED,
    needs=[checks.answers_with_the_last_message, checks.says_when_it_knows_nothing],
    see=checks.KNOWS_NOTHING,
)

keeps_the_last_message = check_of(
    [model.repeats_the_last_message, model.says_when_it_knows_nothing],
    title="It responds with the last message, also after any pause and any earlier messages",
    on=ANY_ORDER,
    needs=checks.follows_the_battery,
)

answers_every_request = check_of(
    [model.answers_in_time, model.never_waits],
    title="Every request gets its response from memory, also eight at once",
    on=ANY_ORDER,
    needs=checks.server_appears,
    see="02_services#m4-why",
)

works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "serves the robot",
    model.repeats_the_last_message,
    on=OTHER_NAMESPACE,
    needs=checks.answers_with_the_last_message,
    clauses=[5],
)
