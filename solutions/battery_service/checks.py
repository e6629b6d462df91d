"""What students can see being checked."""

from __future__ import annotations

import math

from autograder.checks import RESTING, CheckList, Scenario, expect
from autograder.common_checks import require_clean_exit
from autograder.readiness import require_ready
from autograder.transcript import Transcript

from .judging import (
    require_first_answer,
    require_last_message,
    require_last_message_at_each_level,
)

CHECKS = CheckList()

ASK_ONCE = Scenario("ask_once", robot=RESTING)
SENSOR_UNPLUGGED = Scenario("ask_before_the_first_message", robot=(*RESTING, "--battery-sensor-unplugged"))
LEVELS = Scenario("ask_at_levels", {"levels": [0.8, 0.35]}, robot=RESTING)
INTERRUPT = Scenario("interrupt", robot=RESTING)


@CHECKS.check(points=1, on=INTERRUPT)  # the shortest scenario: its verdict comes first
def server_appears(run: Transcript) -> None:
    """The node offers get_battery_status"""
    require_ready(run)


@CHECKS.check(points=1, on=ASK_ONCE, needs=["server_appears"])
def answers_with_the_last_message(run: Transcript) -> None:
    """It answers with the robot's last battery_state, field by field"""
    require_last_message(run)


@CHECKS.check(points=2, on=SENSOR_UNPLUGGED, needs=["server_appears"])
def says_when_it_knows_nothing(run: Transcript) -> None:
    """Before the first message it answers available: false and a percentage of NaN"""
    answer = require_first_answer(run)
    response = answer.response
    expect(
        response["available"] is False,
        expected="available: false, because the robot has not published its battery yet",
        observed=f"available: {str(response['available']).lower()}",
        help="Start with no message (None) and answer available: false as long as none has arrived.",
        at=answer.t,
    )
    percentage = response["battery"]["percentage"]
    expect(
        math.isnan(percentage),
        expected="battery.percentage: NaN, ROS's sign for 'not measured'",
        observed=f"battery.percentage: {percentage:g}, which a client would take for a measured value",
        help="A new BatteryState holds 0.0 everywhere: set the fields that are not measured to float('nan').",
        at=answer.t,
    )


@CHECKS.check(points=1, on=LEVELS, needs=["answers_with_the_last_message"])
def follows_the_battery(run: Transcript) -> None:
    """When the charge changes, so does the answer"""
    require_last_message_at_each_level(run)


@CHECKS.check(points=1, on=INTERRUPT, needs=["server_appears"])
def ends_cleanly(run: Transcript) -> None:
    """Ctrl-C ends the node with exit status 0"""
    require_clean_exit(run)
