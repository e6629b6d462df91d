"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from functools import partial
from random import Random
from typing import Any

from autograder.authoring import Scenario, check_of, in_order, shuffled
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .checks import KNOWS_NOTHING, SOME_JOINTS, STRANGERS, UNPLUGGED, UNPLUGGED_ROBOT

PARTS = [
    *("hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll"),
    *("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_yaw", "wrist_pitch", "wrist_roll"),
]
FINGERS = ["l_finger_1", "l_finger_2", "r_finger_1", "r_finger_2"]
TRUNK = ["waist_yaw", "waist_pitch", "head_pan", "head_tilt"]
JOINTS = [*TRUNK, *(f"{side}_{part}" for part in PARTS for side in "lr")]
MOST_AT_ONCE = 8  # a service keeps its last 10 requests


def _steps(random: Random) -> dict[str, Any]:
    """Call the service before the first message, then in any order.

    With other positions and orders of the joints, during pauses, for unknown names, and many times at once.
    """

    def joints() -> list[str]:
        return random.sample([*JOINTS, *FINGERS], random.randint(1, 5))

    def strangers(number: int = 3) -> list[str]:
        name = random.choice(JOINTS)
        near = [name.upper(), name.title(), f" {name}", f"{name} ", random.choice(PARTS), ""]
        return random.sample([*near, *STRANGERS], number)

    def mixed() -> list[str]:
        names = [*joints(), *(unknown := strangers(7)), unknown[0]]
        return random.sample(names, len(names))

    def repeated() -> list[str]:
        names = joints()
        return random.sample([*names, *names, names[0]], 2 * len(names) + 1)

    def readings() -> dict[str, float]:
        names = random.sample(JOINTS, 6)
        away = {name: round(random.uniform(-7.0, 7.0), 7) for name in names}
        return {**away, names[0]: 0.0, names[1]: away[names[1]] / 1000, random.choice(FINGERS): 0.0234567}

    def seconds(least: float, most: float) -> float:
        return round(random.uniform(least, most), 1)

    first, second, third, fourth, fifth = (readings() for _ in range(5))
    burst = [[], joints(), joints(), repeated(), mixed(), joints(), strangers(), joints()]
    at_the_very_last: list[list[Any]] = []
    for position in (0.8, -0.8, 0.8, -0.8):
        turned: list[list[Any]] = [["turn", "head_pan", position], ["wait", 0.6], ["unplug"], ["let_arrive"]]
        at_the_very_last += [*turned, ["ask", ["head_pan"]], ["plug_in"]]
    keeping_on: list[list[Any]] = [["ask", ["head_pan"]], ["wait", 0.1]] * 12
    blocks: list[list[list[Any]]] = [
        [
            *(["read", first], ["let_arrive"], ["ask", [*first]], ["read", second]),
            *(["reverse", True], ["let_arrive"], ["ask", [*first, *second], []], ["reverse", False]),
        ],
        [["alternate", True], ["let_arrive"], *(["ask", joints()] for _ in range(8)), ["alternate", False]],
        [
            *(["unplug"], ["read", third], ["wait", seconds(6.0, 10.0)]),
            *(["ask", [*third]], ["ask", []], ["plug_in"]),
        ],
        [["read", {}], *at_the_very_last],
        [
            *(["set_clock", -round(seconds(60.0, 4000.0))], ["read", fifth], ["let_arrive"]),
            *(["ask", [*fifth]], ["set_clock", 0]),
        ],
        [["ask", *random.sample(burst, MOST_AT_ONCE)]],
        [["ask", [""], strangers()[:1]], ["ask", mixed()], ["ask", joints()], ["ask", repeated()]],
        [["read", {}], ["turn", "head_pan", 0.8], *keeping_on],
    ]
    any_order = shuffled(random, blocks)
    before = [
        *(["ask", joints()], ["ask", []], ["wait", seconds(0.5, 1.5)]),
        ["ask", *random.sample(burst, random.randint(2, MOST_AT_ONCE))],
    ]
    after = [["plug_in"], ["read", fourth], ["let_arrive"], ["ask", [*fourth]], ["ask", joints(), []]]
    return {"steps": [*before, *after, *any_order]}


ANY_ORDER = Scenario("in_order", _steps, robot=UNPLUGGED_ROBOT)
OTHER_NAMESPACE = in_order(["let_arrive"], ["ask", SOME_JOINTS], namespace="/lab_7/robot")

in_any_order = partial(check_of, on=ANY_ORDER)

recovers_when_the_sensors_appear = check_of(
    [model.finds_the_joints, model.positions_are_the_last],
    title="After the first message it responds with that message",
    on=UNPLUGGED,
    needs=[checks.positions_are_the_robots, checks.says_when_it_knows_nothing],
    see=KNOWS_NOTHING,
)

answers_in_any_posture = in_any_order(
    [
        model.finds_the_joints,
        model.positions_are_the_last,
        model.keeps_up_with_a_motion,
        model.lists_every_joint_once,
        model.says_when_it_knows_nothing,
    ],
    title="It responds with the last message unchanged, also after any pause and any earlier messages",
    needs=checks.follows_the_robot,
)

answers_every_request = in_any_order(
    [model.answers_in_time, model.never_waits, model.keeps_the_order_asked],
    title="Every request gets its own joints at once, also eight different requests together",
    needs=checks.keeps_the_order_asked,
    see="02_services#m4-why",
)

looks_joints_up_by_name = in_any_order(model.goes_by_names_not_places, needs=checks.positions_are_the_robots)

takes_no_joint_for_another = in_any_order(
    [model.refuses_unknown_joints, model.names_every_unknown_joint],
    title="It compares names exactly: unknown names, parts, other capitals or blanks get success false",
    needs=checks.names_every_unknown_joint,
)

works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "serves the robot",
    model.positions_are_the_last,
    on=OTHER_NAMESPACE,
    needs=checks.positions_are_the_robots,
    clauses=[7],
)
