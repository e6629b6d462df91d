"""Chapter 2: services."""

from __future__ import annotations

import math
from functools import partial

from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

from humanoid_interfaces.srv import GetBatteryStatus
from lab.client.commands import publish
from lab.client.waiting import becomes_true
from lab.learning.gap import Gap, expect
from lab.learning.gap_check_helpers import call_student_service, read_program, run_student_code
from lab.running.robot import end_robot, start_robot
from lab.running.student_nodes import StudentNode, run_node

ROBOT_STATE_TIMEOUT = 5.0  # s, on a busy machine
STOP_AND_REPORT, WALK_HOME, GO_ON = "stop and report", "walk home", "go on"
DECISIONS = (  # available, percentage, the right decision, the advice after a wrong one
    (
        False,
        0.0,
        STOP_AND_REPORT,
        "check response.available first: while it is false, the percentage has no meaning",
    ),
    (
        False,
        0.9,
        STOP_AND_REPORT,
        "check response.available first: while it is false, the percentage has no meaning",
    ),
    (True, math.nan, STOP_AND_REPORT, "NaN is neither below nor above 0.20: test math.isnan(level)"),
    (True, 15.0, STOP_AND_REPORT, "a percentage is between 0 and 1: treat a number above 1 as unknown"),
    (True, -1.0, STOP_AND_REPORT, "a percentage is between 0 and 1: treat a number below 0 as unknown"),
    (
        True,
        0.0,
        WALK_HOME,
        "0.0 is a valid charge, an empty battery: return the decision for a charge below 0.20",
    ),
    (True, 0.19, WALK_HOME, "0.19 is below 0.20: return the decision for a charge below 0.20"),
    (True, 0.21, GO_ON, "0.21 is known, and it is not below 0.20: return the third text"),
    (True, 1.0, GO_ON, "1.0 is a valid charge, a full battery: return the third text"),
)


def answers_without_odom() -> str:
    """Call where_am_i while no robot publishes odom."""
    end_robot()
    server = run_node("where_am_i_fixed.py")
    hints = {
        "'NoneType' object": "return response inside the `if`: without a return the callback goes on and reads odom"
    }
    response = call_student_service(server, "where_am_i", Trigger, hints=hints)
    expect(
        not response.success,
        seen="success=True although no odom has arrived",
        expected="success=False",
        next="set response.success = False before you return",
    )
    expect(
        response.message,
        seen="success=False with an empty message",
        expected="a message for people that says why",
        next="set response.message",
    )
    return f"without odom it responded success=False, {response.message!r}, and it still runs"


def refuses_an_impossible_start() -> str:
    """Request a start and a stop without a robot, with one that stands, and with one whose motors are off."""
    end_robot()
    server = run_node("march.py")
    try:
        unknown = _refused_start(
            server,
            "before the first robot_state",
            "if request.data is true and self.state is None, set success to False and return response",
        )
        _require_stop(server, "before the first robot_state")
        start_robot()
        accepts = becomes_true(lambda: _march(server, True).success, ROBOT_STATE_TIMEOUT)
        expect(
            accepts,
            seen="success=False for a start although robot_state has motors_enabled true",
            expected="success=True",
            next="refuse a start only if `not self.state.motors_enabled`",
        )
        publish("motor_power", Bool(data=False))
        becomes_true(lambda: not _march(server, True).success, ROBOT_STATE_TIMEOUT)
        off = _refused_start(
            server,
            "while the motors are off",
            "if request.data is true and self.state.motors_enabled is not, set success to False "
            "and return response",
        )
        expect(
            off != unknown,
            seen=f"the same message in both cases: {off!r}",
            expected="two messages: one for the unknown state, one for motors that are off",
            next="write two branches, each with its own message",
        )
        _require_stop(server, "while the motors are off")
    finally:
        end_robot()
    return f"it refused a start with {unknown!r} and with {off!r}, and never a stop"


def _refused_start(server: StudentNode, when: str, next: str) -> str:
    """Request a start that must be refused, and return the message of the refusal."""
    response = _march(server, True)
    expect(not response.success, seen=f"success=True for a start {when}", expected="success=False", next=next)
    expect(
        response.message,
        seen=f"an empty message for a start {when}",
        expected="a message for people that says why",
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
    return (
        f"it made the right decision in {len(DECISIONS)} cases, and returned {STOP_AND_REPORT!r} when the charge was "
        "unknown"
    )


GAPS = (
    Gap("where_am_i_fixed.py", answers_without_odom),
    Gap("march.py", refuses_an_impossible_start),
    Gap("careful_planner.py", decides_by_what_is_known),
)
