"""How answers of the motor services are compared with the motors of the simulated robot."""

from __future__ import annotations

from autograder.checks import expect
from autograder.exercises.common_checks import DELIVERY, require_answer
from autograder.transcript import CallHistory, Transcript

MODES = ("OFF", "STANDING", "WALKING", "FALLEN")  # by their number in humanoid_interfaces/RobotState
WALKING = MODES.index("WALKING")


def require_status(run: Transcript, index: int, on: bool) -> None:
    """The answer says what the robot's motors are."""
    answer = require_answer(run, run.calls[index])
    wanted = f"Motors: {'ON' if on else 'OFF'}"
    response = answer.response
    expect(
        response["success"] is True and response["message"] == wanted,
        expected=f"success: true, message: {wanted!r}; the robot's motors are {_on_or_off(on)}",
        observed=_shown(response),
        help=_advice_on_status(response, wanted, first=index == 0),
        at=answer.t,
    )


def require_granted(run: Transcript, index: int) -> None:
    """The request was answered with success, and the robot's motors are as it asked."""
    call = run.calls[index]
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
    expect(
        run.robot_at(answer.t + DELIVERY).motors_enabled is on,
        expected=f"the robot's motors {_on_or_off(on)} within {DELIVERY:.0f} s of the answer to {_question(call)}",
        observed=f"they are {_on_or_off(not on)}, though the answer was success",
        help="Publish std_msgs/Bool(data=request.data) on motor_power (relative name), with a publisher made in the "
        "constructor: one made in the callback may not have found the robot yet.",
        at=answer.t + DELIVERY,
    )


def require_refused(run: Transcript, index: int) -> None:
    """Power off was refused with a sentence, and the robot walked on."""
    call = run.calls[index]
    answer = require_answer(run, call)
    expect(
        run.robot_at(call.sent.t).mode == WALKING,
        expected="the robot walking when power off is asked for, as it was told",
        observed=f"it is {_mode(run, call.sent.t)}",
        help="Publish nothing unasked: motor_power only when a request is granted, and cmd_vel never.",
        at=call.sent.t,
    )
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
    require_walking_on(run, index)


def require_walking_on(run: Transcript, index: int) -> None:
    """The motors kept their power, and the robot still walks a while after the answer."""
    call = run.calls[index]
    answer = require_answer(run, call)
    watched = run.robot_between(call.sent.t, answer.t + DELIVERY)
    last = next((robot for robot in watched if not robot.motors_enabled), watched[-1])
    expect(
        last.motors_enabled and last.mode == WALKING,
        expected=f"the robot walking on after {_question(call)}",
        observed=f"it is {MODES[last.mode]}, its motors are {_on_or_off(last.motors_enabled)}",
        help="Return before anything is published when a request is refused; where it is granted, publish what "
        "data says.",
        at=last.t,
    )


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
