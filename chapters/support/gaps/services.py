"""Chapter 2: services."""

from __future__ import annotations

import math
from functools import partial

from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

from humanoid_interfaces.srv import GetBatteryStatus
from lab.client.commands import publish
from lab.client.waiting import comes_true
from lab.learning.gap import Gap, expect
from lab.learning.gap_check_helpers import call_student_service, read_program, run_student_code
from lab.running.robot import start_robot, stop_robot
from lab.running.student_nodes import StudentNode, run_node

ROBOT_STATE_TIMEOUT = 5.0  # s, on a busy machine
UNKNOWN, HOME, ON = "stop and report", "walk home", "go on"
DECISIONS = (  # available, percentage, what to do, what to look at when something else is done
    (False, 0.0, UNKNOWN, "look at response.available first: while it is false, the number means nothing"),
    (False, 0.9, UNKNOWN, "look at response.available first: while it is false, the number means nothing"),
    (True, math.nan, UNKNOWN, "NaN is neither below nor above 0.20: ask math.isnan(level)"),
    (True, 15.0, UNKNOWN, "a percentage runs from 0 to 1: don't believe a number above 1"),
    (True, -1.0, UNKNOWN, "a percentage runs from 0 to 1: don't believe a number below 0"),
    (True, 0.0, HOME, "0.0 is a charge like any other: the battery is empty"),
    (True, 0.19, HOME, "0.19 is below 0.20"),
    (True, 0.21, ON, "0.21 is known, and it is not below 0.20"),
    (True, 1.0, ON, "1.0 is a full battery"),
)


def answers_without_odom() -> str:
    """Ask for the position while no robot publishes odom."""
    stop_robot()
    server = run_node("where_am_i_fixed.py")
    hints = {"'NoneType' object": "return response inside the `if`: without it the callback goes on to odom"}
    response = call_student_service(server, "where_am_i", Trigger, hints=hints)
    expect(
        not response.success,
        seen="success=True without one message on odom",
        expected="success=False",
        next="set response.success = False before you return",
    )
    expect(
        response.message,
        seen="an empty message",
        expected="a sentence for people that says why",
        next="set response.message",
    )
    return f"without odom it answered success=False, {response.message!r}, and still runs"


def refuses_an_impossible_start() -> str:
    """Ask for a start and a stop: without a robot, with one, and with one whose motors are off."""
    stop_robot()
    server = run_node("march.py")
    try:
        unknown = _refused_start(
            server,
            "before the first robot_state",
            "if request.data is true and self.state is None, set success to False and return response",
        )
        _require_stop(server, "before the first robot_state")
        start_robot()
        heard = comes_true(lambda: _march(server, True).success, ROBOT_STATE_TIMEOUT)
        expect(
            heard,
            seen="a start is refused although robot_state says motors_enabled",
            expected="success=True",
            next="refuse a start only if `not self.state.motors_enabled`",
        )
        publish("motor_power", Bool(data=False))
        comes_true(lambda: not _march(server, True).success, ROBOT_STATE_TIMEOUT)
        off = _refused_start(
            server,
            "while the motors are off",
            "if request.data is true and self.state.motors_enabled is not, set success to False "
            "and return response",
        )
        expect(
            off != unknown,
            seen=f"the same message in both cases: {off!r}",
            expected="a message for each: nothing known of the robot, and motors off",
            next="make two branches, each with its own message",
        )
        _require_stop(server, "while the motors are off")
    finally:
        stop_robot()
    return f"it refused a start with {unknown!r} and with {off!r}, and never a stop"


def _refused_start(server: StudentNode, when: str, next: str) -> str:
    """Return the message with which a start is refused."""
    response = _march(server, True)
    expect(not response.success, seen=f"success=True for a start {when}", expected="success=False", next=next)
    expect(
        response.message,
        seen=f"an empty message for a start {when}",
        expected="a sentence for people that says why",
        next="set response.message",
    )
    return response.message


def _require_stop(server: StudentNode, when: str) -> None:
    expect(
        _march(server, False).success,
        seen=f"success=False for a stop {when}",
        expected="success=True: a client can always stop the robot",
        next="refuse only if request.data is true",
    )


def _march(server: StudentNode, on: bool) -> SetBool.Response:
    hints = {"'NoneType' object": "test `self.state is None` before you read self.state.motors_enabled"}
    return call_student_service(server, "march", SetBool, SetBool.Request(data=on), hints=hints)


def decides_by_what_is_known() -> str:
    """Call decide() with known and unknown charges."""
    decide = read_program("careful_planner.py")["decide"]
    for available, percentage, right, advice in DECISIONS:
        response = GetBatteryStatus.Response(available=available)
        response.battery.percentage = percentage
        decision = run_student_code(partial(decide, response), "careful_planner.py")
        expect(
            decision == right,
            seen=f"with available={available}, percentage={percentage} it returned {decision!r}",
            expected=f"{right!r}",
            next="end each path with `return` and one of the three texts" if decision is None else advice,
        )
    return f"it decided {len(DECISIONS)} cases, and stops when it doesn't know the charge"


GAPS = (
    Gap("where_am_i_fixed.py", answers_without_odom),
    Gap("march.py", refuses_an_impossible_start),
    Gap("careful_planner.py", decides_by_what_is_known),
)
