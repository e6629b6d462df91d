"""Advice on wrong responses of the motor services, from the record of the run."""

from __future__ import annotations

import math

from autograder.authoring import DELIVERY, Call, ev, shown, why_no_command_arrives, why_no_message_arrives

MIN_WAIT = 0.7  # s; a response that took longer waited for the robot
MIN_CONFIRMATION_WAIT = 1.8  # s before a response may report a missing confirmation; the task says 2 s
SWITCH_TIME = 1.5  # s after a response, within which the motors would have been switched
_FROM_THE_LAST = "Keep the last robot_state, and respond according to its motors_enabled."
_SAID = {"Motors: ON": True, "Motors: OFF": False}


def on_status(call: Call, wanted: str) -> str:
    """Return advice on a wrong response of get_status."""
    response = call.response
    if response.message == wanted:
        return "Set success to True: it says whether the status is known, not whether the motors are on."
    if response.message.strip().rstrip(".").lower() == wanted.lower():
        return f"Spell the text exactly like this, as programs compare it: {wanted!r}."
    if cause := why_no_message_arrives(call.run, "robot_state"):
        return f"{cause} {_FROM_THE_LAST}"
    if history := _history_of_the_status(call):
        return f"{history} {_FROM_THE_LAST}"
    if not response.success:
        return "Your node receives robot_state: in each request check whether a message has come."
    return f"Your node receives robot_state. {_FROM_THE_LAST}"


def _history_of_the_status(call: Call) -> str:
    """Return the pattern in the responses of get_status: constant, like the last request, or always inverted; or ''."""
    run = call.run
    said = [
        (_SAID[answer.response.message], asked.t)
        for asked in run.all(ev.ServiceCalled)
        if asked.service == "get_status" and (answer := run.one(ev.ServiceAnswered, "call", asked.call))
        if answer.response.message in _SAID
    ]
    if not said:
        return ""
    truth = [[robot.motors_enabled for robot in run.ground_truth if robot.t <= t][-1:] for _on, t in said]
    if all(true == [not on] for (on, _t), true in zip(said, truth, strict=True)):
        return "get_status reported the opposite of the robot's state: motors_enabled true means ON."
    asked_all = run.all(ev.ServiceCalled)
    requests = [(asked.t, asked.request.data) for asked in asked_all if asked.service == "enable_motors"]
    after = [(on, [data for asked_at, data in requests if asked_at < t][-1:]) for on, t in said]
    if any(asked for _on, asked in after) and all(asked in ([], [on]) for on, asked in after):
        return "get_status reported the last request to enable_motors, not the robot's state."
    if len({on for on, _t in said}) == 1 and len(said) > 1:
        return "get_status always reported the same, although the robot's motors were switched."
    return ""


def on_power(call: Call) -> str:
    """Return what the grader received on motor_power, and advice."""
    run, wanted = call.run, call.request.data
    publish = f"Publish Bool(data=request.data) on motor_power when you accept {question(call)}."
    if seen := why_no_command_arrives(run, "motor_power", before=call.answered.t):
        return f"On motor_power the grader received {seen}. {publish}"
    sent = [other.t for other in run.all(ev.ServiceCalled) if other.service == call.service]
    later = min((t for t in sent if t > call.sent.t), default=math.inf)
    received = [message for message in run.all(ev.MotorPowerReceived) if call.sent.t <= message.t < later]
    if not received:
        return f"On motor_power the grader received no message after the request. {publish}"
    if received[-1].on is not wanted:
        return f"On motor_power the grader received data: {shown(received[-1].on)}. {publish}"
    return f"The right message came on motor_power, but too late. {publish}"


def on_granting(call: Call, situation: str) -> str:
    """Return advice on a request that was wrongly rejected."""
    if MIN_WAIT < call.latency < MIN_CONFIRMATION_WAIT:
        return f"Your server waited for robot_state for only {call.latency:.1f} s: wait for 2 to 4 s."
    before, after = _had_power(call, call.sent.t), _had_power(call, call.answered.t + DELIVERY)
    if before is not call.request.data and after is call.request.data:
        return "The motors were switched, but success is false: set it to True when you accept the request."
    if call.request.data:
        return "Always accept data: true. Reject only data: false, and only if the last robot_state.mode is WALKING."
    return f"Reject data: false only if the last robot_state.mode is WALKING. Here it was {situation}."


def on_refusing(call: Call) -> str:
    """Return advice on a request that was wrongly accepted."""
    if _had_power(call, call.answered.t + SWITCH_TIME):
        if not call.response.message.strip():
            return "Nothing was switched off, but success is true: set response.success = False, and give the reason."
        return "Nothing was switched off, but success is true: set response.success = False, which fits your message."
    if cause := why_no_message_arrives(call.run, "robot_state"):
        return f"{cause} Without it the node cannot know that the robot walks."
    return (
        "If data is false and the last robot_state.mode is RobotState.WALKING, which is a number, set success to false "
        "and publish nothing."
    )


def _had_power(call: Call, t: float) -> bool | None:
    """Return whether the motors had power at a time (s), if that is known."""
    seen = [robot for robot in call.run.ground_truth if robot.t <= t]
    return seen[-1].motors_enabled if seen else None


def question(call: Call) -> str:
    """Return a request in words: the service and its data."""
    data = getattr(call.request, "data", None)
    return call.service if data is None else f"{call.service} (data: {shown(data)})"


def on_or_off(on: bool) -> str:
    """Return 'on' or 'off'."""
    return "on" if on else "off"
