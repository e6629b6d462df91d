"""How answers of the motor services are compared with the motors of the simulated robot."""

from __future__ import annotations

import math

from autograder.authoring import events as ev
from autograder.authoring.checks import expect
from autograder.authoring.missing import unseen
from autograder.authoring.server_checks import DELIVERY, require_answer
from autograder.authoring.transcript import CallHistory, Transcript

ENABLE, STATUS = "enable_motors", "get_status"
MODES = ("OFF", "STANDING", "WALKING", "FALLEN")  # by their number in humanoid_interfaces/RobotState
WALKING = MODES.index("WALKING")
OBEYED = 2.0  # s after the answer in which the motors must be as asked
WATCHED = 1.5  # s after the answer in which the robot must walk on


def require_status(run: Transcript, number: int, on: bool) -> None:
    """The first (`number` 1), second, … answer says what the robot's motors are: they have been so for a while."""
    call = run.call(STATUS, number)
    _require_motors_known(run, call, on)
    answer = require_answer(run, call)
    wanted = f"Motors: {_on_or_off(on).upper()}"
    response = answer.response
    expect(
        response["success"] is True and response["message"] == wanted,
        expected=f"success: true, message: {wanted!r}; the robot's motors are {_on_or_off(on)}",
        observed=_shown(response),
        help=_advice_on_status(response, wanted, first=number == 1),
        at=answer.t,
    )


def require_status_after_a_change(run: Transcript, number: int, on: bool) -> None:
    """The answer says what the motors are after the scenario, and not the node, has switched them."""
    call = run.call(STATUS, number)
    run.told("motor_power", before=call.sent.t - DELIVERY, on=on)
    require_status(run, number, on)


def require_granted(run: Transcript, number: int) -> None:
    """The first (`number` 1), second, … request was answered with success, and the motors are soon as it asked."""
    call = run.call(ENABLE, number)
    answer = require_answer(run, call)
    on = call.sent.request["data"]
    expect(
        answer.response["success"] is True,
        expected=f"success: true to {_question(call)} while the robot is {_mode(run, call.sent.t)}",
        observed=_shown(answer.response),
        help="success tells whether the request is granted, not what data was. Refuse only power off, and only "
        "while the last robot_state.mode is WALKING.",
        at=answer.t,
    )
    end = min(answer.t + OBEYED, _next_question(run, call), run.end)
    watched = run.robot_between(call.sent.t, max(end, answer.t + DELIVERY))
    expect(
        watched[-1].motors_enabled is on,
        expected=f"the robot's motors {_on_or_off(on)} within {OBEYED:.0f} s of the answer to {_question(call)}",
        observed=f"they are {_on_or_off(not on)}, though the answer was success",
        help="Publish std_msgs/Bool(data=request.data) on motor_power (relative name), with a publisher made in the "
        "constructor: one made in the callback may not have found the robot yet.",
        at=watched[-1].t,
    )


def require_switched(run: Transcript, number: int) -> None:
    """The request was granted, and it changed something: before it the motors were the other way."""
    call = run.call(ENABLE, number)
    on = call.sent.request["data"]
    expect(
        run.robot_at(call.sent.t).motors_enabled is not on,
        expected=f"the robot's motors {_on_or_off(not on)} until {_question(call)} is asked for",
        observed=f"they are {_on_or_off(on)} before",
        help="Publish on motor_power only when a request is granted.",
        at=call.sent.t,
    )
    require_granted(run, number)


def require_refused(run: Transcript, number: int) -> None:
    """Power off was refused with a sentence, and the robot walked on."""
    call = run.call(ENABLE, number)
    answer = require_answer(run, call)
    require_walking_as_told(run, call)
    expect(
        answer.response["success"] is False,
        expected=f"success: false to {_question(call)} while the robot is WALKING",
        observed=_shown(answer.response),
        help="Keep the last robot_state, and answer success: false when data is false and its mode is "
        "RobotState.WALKING.",
        at=answer.t,
    )
    expect(
        bool(answer.response["message"].strip()),
        expected="a message that says why power off is refused",
        observed="an empty message",
        help='Set response.message, for example to "the robot is walking: stop it first".',
        at=answer.t,
    )
    require_walking_on(run, number)


def require_walking_as_told(run: Transcript, call: CallHistory) -> None:
    """The robot walked when the question came, and had for long enough that the node knew."""
    told = run.told("walk", before=call.sent.t - DELIVERY)
    watched = run.robot_between(call.sent.t - DELIVERY, call.sent.t)
    idle = next((robot for robot in watched if robot.mode != WALKING), None)
    expect(
        idle is None and any(told.command["velocity"]),
        expected="the robot walking when power off is asked for, as it was told",
        observed=f"it is {_mode(run, idle.t if idle else call.sent.t)}",
        help=_NOTHING_UNASKED,
        at=call.sent.t,
    )


def require_standing_as_told(run: Transcript, number: int) -> None:
    """The robot was told to stop, and stood when the question came, for long enough that the node knew."""
    call = run.call(ENABLE, number)
    run.told("walk", before=call.sent.t - DELIVERY, velocity=[0.0, 0.0, 0.0])
    watched = run.robot_between(call.sent.t - DELIVERY, call.sent.t)
    expect(
        all(robot.mode != WALKING for robot in watched),
        expected="the robot standing when power off is asked for again, as it was told",
        observed=f"it is {_mode(run, call.sent.t)}",
        help=_NOTHING_UNASKED,
        at=call.sent.t,
    )


def require_walking_on(run: Transcript, number: int) -> None:
    """The motors kept their power, and the robot still walks a while after the answer."""
    call = run.call(ENABLE, number)
    answer = require_answer(run, call)
    watched = run.robot_between(call.sent.t, answer.t + WATCHED)
    last = next((robot for robot in watched if not robot.motors_enabled), watched[-1])
    expect(
        last.motors_enabled and last.mode == WALKING,
        expected=f"the robot walking on after {_question(call)}",
        observed=f"it is {MODES[last.mode]}, its motors are {_on_or_off(last.motors_enabled)}",
        help="Return before anything is published when a request is refused; where it is granted, publish what "
        "data says.",
        at=last.t,
    )


def require_silence_so_far(run: Transcript) -> CallHistory:
    """Return the first question for the status, which came before the robot had said anything."""
    call = run.call(STATUS, 1)
    answer = require_answer(run, call)
    if any(command.t <= answer.t for command in run.all(ev.RobotCommanded)):
        raise unseen(run, "the robot published its state too early")
    return call


_NOTHING_UNASKED = "Publish nothing unasked: motor_power only when a request is granted, and cmd_vel never."


def _require_motors_known(run: Transcript, call: CallHistory, on: bool) -> None:
    """The motors were as they are for long enough that the node knew."""
    watched = run.robot_between(call.sent.t - DELIVERY, call.sent.t)
    other = next((robot for robot in watched if robot.motors_enabled is not on), None)
    expect(
        other is None,
        expected=f"the robot's motors {_on_or_off(on)} when {_question(call)} is asked",
        observed=f"they are {_on_or_off(not on)}",
        help="Publish on motor_power when a request is granted, at once, and never else.",
        at=other.t if other else None,
    )


def _next_question(run: Transcript, call: CallHistory) -> float:
    """When the next request for the motors was sent (s): from then on they may change again."""
    later = [other.sent.t for other in run.calls_to(ENABLE) if other.sent.t > call.sent.t]
    return min(later, default=math.inf)


def _advice_on_status(response: dict, wanted: str, first: bool) -> str:
    if response["message"] == wanted:
        return "success tells whether the question could be answered, not whether the motors are on: set it to True."
    if response["message"].strip().rstrip(".").lower() == wanted.lower():
        return f"The text is compared letter by letter, as a program would: {wanted!r}."
    if first or not response["success"]:
        return (
            "Subscribe to robot_state (relative name), keep its last message, and answer from "
            "motors_enabled in it."
        )
    return (
        "Somebody else switched the motors. Answer from motors_enabled of the last robot_state; do not keep a "
        "flag of what was asked for, or only the first message."
    )


def _question(call: CallHistory) -> str:
    data = call.sent.request.get("data")
    return call.sent.service if data is None else f"{call.sent.service} (data: {str(data).lower()})"


def _shown(response: dict) -> str:
    return f"success: {str(response['success']).lower()}, message: {response['message']!r}"


def _mode(run: Transcript, t: float) -> str:
    return MODES[run.robot_at(t).mode]


def _on_or_off(on: bool) -> str:
    return "on" if on else "off"
