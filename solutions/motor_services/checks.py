"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario, check, expect
from autograder.authoring.fields import shown_fields
from autograder.authoring.robot_topic import require_nothing_published
from autograder.authoring.transcript import Transcript

from .judging import (
    require_refused,
    require_status,
    require_status_after_a_change,
    require_switched,
)

# A stand holds the robot by its chest, so that it hangs limp without power and stands when it returns.
ON_A_STAND = ("--scene", "stand")
INTERRUPT = Scenario("interrupt", robot=RESTING)
STATUS = Scenario("tell_the_status", robot=ON_A_STAND)
SILENT_ROBOT = Scenario("ask_before_the_first_message", robot=(*RESTING, "--robot-state-unpublished"))
SWITCH = Scenario("switch_off_and_on", robot=ON_A_STAND)
WALK = Scenario("switch_off_while_walking", {"velocity": [0.3, 0.0, 0.0]})


server_appears = standard.server_appears(
    "enable_motors and get_status", points=1, on=INTERRUPT, see="02_services#first-file"
)


@check(points=1, on=STATUS, needs=server_appears, see="02_services#first-file")
def tells_the_status(run: Transcript) -> None:
    """get_status says "Motors: ON" while the motors are on"""
    require_status(run.call("status at first"), on=True)


@check(points=2, on=STATUS, needs=tells_the_status, see="02_services#diagram")
def follows_the_robot(run: Transcript) -> None:
    """When somebody else cuts the power and returns it, get_status says so"""
    require_status_after_a_change(run.call("status after off"), on=False)
    require_status_after_a_change(run.call("status after on"), on=True)


@check(points=1, on=SILENT_ROBOT, needs=server_appears, see="02_services#m9-fix-why")
def says_when_it_knows_nothing(run: Transcript) -> None:
    """Before the first robot_state, get_status answers success: false"""
    call = run.call("before the first message")
    require_nothing_published(call, ev.RobotCommanded, "robot_state")
    expect(
        not call.response.success and call.response.message not in ("Motors: ON", "Motors: OFF"),
        expected="success: false and a message that claims neither ON nor OFF: robot_state has not arrived yet",
        observed=shown_fields(call.response, "success", "message"),
        help="Start with no message (None) and answer success: false as long as none has arrived.",
        at=call.answered.t,
    )


@check(points=2, on=SWITCH, needs=server_appears, see="02_services#set-file")
def powers_off(run: Transcript) -> None:
    """enable_motors with data: false is granted to a standing robot, and its motors lose their torque"""
    require_switched(run.call("off"))


@check(points=1, on=SWITCH, needs=powers_off, see="02_services#set-file")
def powers_on(run: Transcript) -> None:
    """enable_motors with data: true is granted, and the motors have their torque again"""
    require_switched(run.call("on"))


@check(points=3, on=WALK, needs=powers_off, see="02_services#set-refuse-why")
def refuses_off_while_walking(run: Transcript) -> None:
    """While the robot walks, power off is refused with a sentence, and it walks on"""
    require_refused(run.call("off while walking"))


ends_cleanly = standard.ends_cleanly(
    points=1, on=INTERRUPT, needs=server_appears, see="02_services#conventions"
)
