"""What students can see being checked."""

from __future__ import annotations

from math import nan

from autograder.authoring import events as ev
from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario, check
from autograder.authoring.robot_topic import require_nothing_published
from autograder.authoring.transcript import Transcript

from .judging import require_at_each_level, require_last_message

ASK_ONCE = Scenario("ask_once", robot=RESTING)
UNPLUGGED = Scenario("ask_before_the_first_message", robot=(*RESTING, "--battery-sensor-unplugged"))
LEVELS = Scenario("ask_at_levels", {"levels": [0.8, 0.35]}, robot=RESTING)
INTERRUPT = Scenario("interrupt", robot=RESTING)


server_appears = standard.server_appears(
    "get_battery_status", points=1, on=INTERRUPT, see="02_services#first-file"
)


@check(points=1, on=ASK_ONCE, needs=server_appears, see="02_services#battery-rules")
def answers_with_the_last_message(run: Transcript) -> None:
    """It answers with the robot's last battery_state, field by field"""
    require_last_message(run.call("once"))


@check(points=2, on=UNPLUGGED, needs=server_appears, see="02_services#m9-fix-why")
def says_when_it_knows_nothing(run: Transcript) -> None:
    """Before the first message it answers available: false and a percentage of NaN"""
    call = run.call("before the first message")
    require_nothing_published(call, ev.BatteryPublished, "battery_state")
    call.expect(
        "available",
        False,
        because="the robot has not published its battery yet",
        help="Start with no message (None) and answer available: false as long as none has arrived.",
    )
    call.expect(
        "battery.percentage",
        nan,
        because="that is ROS's sign for 'not measured', and a client would take any number for a measured one",
        help="A new BatteryState holds 0.0 everywhere: set the fields that are not measured to float('nan').",
    )


@check(points=1, on=LEVELS, needs=answers_with_the_last_message, see="02_services#battery-rules")
def follows_the_battery(run: Transcript) -> None:
    """When the charge changes, so does the answer"""
    require_at_each_level(run)


ends_cleanly = standard.ends_cleanly(
    points=1, on=INTERRUPT, needs=server_appears, see="02_services#conventions"
)
