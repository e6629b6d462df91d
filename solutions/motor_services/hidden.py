"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from random import Random
from typing import Any

from autograder.authoring import Scenario, check_of, in_order, shuffled
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model


def _on_the_floor(random: Random) -> dict[str, Any]:
    """Switch the power while the robot walks sideways, back or in place, when it stands, falls, and lies on the floor.

    In one step robot_state pauses while it walks.
    """
    side = random.choice((-1, 1))
    velocities = (
        [0.0, 0.0, side * random.uniform(0.25, 0.4)],
        [0.0, side * random.uniform(0.07, 0.11), 0.0],
        [-random.uniform(0.1, 0.18), 0.0, 0.0],
    )
    walking: list[list[list[Any]]] = [
        [["switch", False, random.randint(1, 3)], ["wait", 1.6]],
        [["switch", True], ["wait", 1.6]],
        [["ask", 1]],
        [["switch", False], ["switch", True], ["switch", False], ["wait", 0.5]],
        [["publish_state", False], ["wait", 5.5], ["switch", False], ["ask", 1], ["publish_state", True]],
    ]
    while_walking = shuffled(random, walking)
    on_the_floor = shuffled(random, [[["switch", True]], [["switch", False]], [["ask", 2]]])
    walk = ["walk", [round(value, 3) for value in random.choice(velocities)]]
    falls = [["stop"], ["ask", 1], ["wait", 1.0], ["switch", False], ["ask", 1], ["wait", 2.5]]
    return {"steps": [walk, *while_walking, *falls, *on_the_floor, ["settle"]]}


def _on_the_stand(random: Random) -> dict[str, Any]:
    """Switch on and off before the first robot_state; then repeatedly, by another node, in pauses, and many at once."""
    first = random.choice((True, False))
    silence = round(random.uniform(0.5, 2.0), 1)
    blocks: list[list[list[Any]]] = [
        [["switch", False], ["switch_elsewhere", True], ["switch", False], ["settle"], ["ask", 1]],
        [["switch", True], ["switch_elsewhere", False], ["switch", True], ["settle"], ["ask", 1]],
        [
            *(["switch_elsewhere", False], ["switch", False], ["ask", 1], ["switch_and_ask", True, 5, 4]),
            *(
                ["settle"],
                ["switch_and_ask", True, 7, 2],
            ),  # already on, so no need to wait for a confirmation
        ],
        [
            *(["switch_elsewhere", first], ["publish_state", False], ["switch_elsewhere", not first]),
            *(["wait", silence], ["ask", 1], ["switch", first], ["switch", not first, 3], ["wait", 2.6]),
            *(["ask", 1], ["publish_state", True], ["ask", 1]),
        ],
    ]
    any_order = shuffled(random, blocks)
    unknown = shuffled(random, [[["switch", True]], [["switch", False]]])
    before = [["ask", 1], *unknown, ["wait", round(random.uniform(0.5, 2.0), 1)], ["ask", 2]]
    return {"steps": [*before, ["publish_state", True], ["ask", 1], *any_order], "interrupt": True}


FLOOR = Scenario("in_order", _on_the_floor)
STAND = Scenario("in_order", _on_the_stand, robot=(*checks.ON_A_STAND, "--robot-state-unpublished"))
SWITCH_AND_ASK = [step for on in (False, True) for step in (["switch", on], ["settle"], ["ask", 1])]
OTHER_NAMESPACE = in_order(*SWITCH_AND_ASK, robot=checks.ON_A_STAND, namespace="/lab_7/robot")

refuses_however_it_walks = check_of(
    [model.refuses_power_off, model.lets_it_walk],
    title="Power off is also rejected while the robot turns in place or walks sideways or backwards",
    on=FLOOR,
    needs=checks.refuses_off_while_walking,
)

refuses_nothing_else = check_of(
    [model.grants_power_on, model.grants_power_off, model.commands_only_what_was_granted],
    title="Power on is always accepted, power off unless the robot walks; a rejected request has no effect",
    points=2,
    on=[FLOOR, STAND],
    needs=checks.powers_on,
    see=checks.REFUSES,
)

recovers_when_the_robot_speaks = check_of(
    model.tells_the_motors,
    title="After the first robot_state, get_status reports the last one, whatever happened before",
    on=[checks.SILENT_ROBOT, STAND, FLOOR],
    needs=checks.tells_the_status,
    see=checks.KNOWS_NOTHING,
)

answers_every_request = check_of(
    [
        model.status_in_time,
        model.status_from_memory,
        model.says_when_it_knows_nothing,
        model.power_in_time,
        model.power_never_sleeps,
    ],
    title="Every request gets its response in time, get_status from memory, also before the first robot_state",
    on=STAND,
    needs=checks.server_appears,
    see="02_services#m4-why",
)

works_in_any_namespace = standard_hidden.works_in_any_namespace(
    *("serves the robot", model.serves_the_robot),
    on=OTHER_NAMESPACE,
    needs=[checks.tells_the_status, checks.powers_on],
)
