"""The checks that students can see and run themselves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import Any

from action_msgs.msg import GoalStatus

from autograder.authoring import Scenario, check_of, program
from autograder.authoring.walking.client_scenarios import ARGUMENTS, way
from humanoid_interfaces.msg import RobotState

from . import model

Server = dict[str, Any]
Steps = list[list[Any]]
FULL = 0.8
UNDER_WAY: Steps = [["await_answer"], ["wait", 0.5]]
WALKING = ["robot", RobotState.WALKING]
WALKS: Steps = [*UNDER_WAY, WALKING, ["wait", 0.3]]
STANDS = ["robot", RobotState.STANDING]
ARRIVES: Server = {"distances": way(8), "ends_after": 2.4}
ON_AND_ON: Server = {"distances": way(100), "ends_after": None}


def script(
    server: Server | None,
    *steps: list[Any],
    battery: float | None = FULL,
    again: bool = True,
    arguments: Sequence[str] = ARGUMENTS,
) -> Server:
    """Return the inputs of a scenario: a server or None, the battery level before the start, and the steps.

    With `again` the battery publishes the same level once more when the program has subscribed.
    """
    first = [["battery", battery]] if again and battery is not None else []
    return {"arguments": list(arguments), "server": server, "battery": battery, "steps": [*first, *steps]}


def guard(server: Server | None, *steps: list[Any], **inputs: Any) -> Scenario:
    """Return the scenario of a script."""
    return program("in_order", script(server, *steps, **inputs))


def levels(*percentages: float, apart: float = 0.3) -> Steps:
    """Return steps that publish these battery levels one after the other, `apart` s apart."""
    return [step for level in percentages for step in (["battery", level], ["wait", apart])]


def stops_after_cancel(stands_after: float | None) -> Steps:
    """Return the steps of a robot that stands `stands_after` s after the cancel request for its goal (None: never)."""
    return [["await_cancel"]] + ([] if stands_after is None else [["wait", stands_after], STANDS])


GOOD = guard(ARRIVES, *UNDER_WAY, *levels(0.71, 0.55, 0.32))
TOO_FEW = guard({}, arguments=("1.5",))
NO_NUMBER = guard({}, arguments=("1.5", "left"))
LOW_BEFORE = guard(ARRIVES, battery=0.12, again=False)
WITHOUT_BATTERY = guard({}, battery=None)
NOBODY = guard(None)
REJECTING = guard({"accepted": False})
ABORTING = guard(
    {
        "distances": way(5),
        "ends_after": 1.0,
        "status": GoalStatus.STATUS_ABORTED,
        "error_code": 3,
        "error_msg": "the way took longer than 52 s",
    },
)
DROP = guard(
    {**ON_AND_ON, "cancel": {"ends_after": 0.6}},
    *(*WALKS, *levels(0.31, 0.19, 0.18, 0.17), *stops_after_cancel(stands_after=2.6)),
)
NO_PERCENTAGE_AT_ALL = guard(
    ARRIVES,
    *(["wait", 1.0], ["battery", 0.9], *UNDER_WAY, *levels(math.nan, 20.0, 15.0, math.nan, -0.3)),
    battery=math.nan,
)
INTERRUPTED = guard({**ON_AND_ON, "cancel": {"ends_after": 1.0}}, *UNDER_WAY, ["press_ctrl_c"])

sends_the_goal = check_of(
    [model.sends_one_goal, model.sends_it_only_when_it_may],
    title="With the battery at 0.80 it sends one goal, at x, y and yaw in frame odom",
    points=2,
    on=GOOD,
)
once_it_sends = partial(check_of, needs=sends_the_goal)
says_how_it_succeeded = once_it_sends(
    [model.compares_exactly, model.ends_with_the_goal],
    title="While the battery is not low the goal is not cancelled; when it SUCCEEDED, the program exits with status 0",
    points=2,
    on=GOOD,
)
refuses_wrong_arguments = once_it_sends(model.refuses_what_is_no_pose, on=[TOO_FEW, NO_NUMBER])
gives_up_without_a_server = check_of(
    [model.gives_up_on_a_missing_server, model.says_why],
    title="Without a server it exits with status 1 after 5 s, and says so on stderr",
    on=NOBODY,
    see="03_clients_that_survive#fix-why",
)
says_how_it_failed = once_it_sends(
    model.says_why,
    title="After a rejected goal it exits with status 2, after an aborted one with 3 and error_msg on stderr",
    on=[REJECTING, ABORTING],
)
does_not_set_out_on_a_low_battery = once_it_sends(
    [model.sends_it_only_when_it_may, model.says_that_the_battery_is_low],
    title="With a latched battery_state of 0.12 it sends no goal, says so on stdout, and exits with status 4",
    points=2,
    on=LOW_BEFORE,
)
does_not_set_out_without_a_battery_state = once_it_sends(
    [model.sends_it_only_when_it_may, model.gives_up_without_a_percentage, model.says_why],
    title="Without any battery_state within 5 s it sends no goal and exits with status 1",
    on=WITHOUT_BATTERY,
)
cancels_when_the_battery_drops = once_it_sends(
    model.cancels_when_low,
    title="When the percentage falls below 0.20 on the way, it cancels the goal once, within 1 s",
    points=2,
    on=DROP,
    see="08_navigation#watch-run",
)
waits_until_the_robot_stands = check_of(
    model.waits_for_canceled_and_standing,
    title="After the cancel it waits for CANCELED and for robot_state STANDING, then exits with status 4",
    points=2,
    on=DROP,
    needs=cancels_when_the_battery_drops,
    see="08_navigation#standing-why",
)
ignores_what_is_no_percentage = once_it_sends(model.ignores_what_is_none, points=2, on=NO_PERCENTAGE_AT_ALL)
ctrl_c_cancels_the_goal = once_it_sends(
    [model.cancels_at_ctrl_c, model.ends_after_ctrl_c],
    title="On Ctrl-C it cancels the goal, waits for its result, and exits with status 4",
    on=INTERRUPTED,
    see="06_walk_to_a_pose#field-why",
)
