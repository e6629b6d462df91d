"""What to do about an answer of the motor services that is wrong, by what the record shows."""

from __future__ import annotations

import math

from autograder.authoring import DELIVERY, Call, ev, shown, why_no_command_arrives, why_no_message_arrives

A_WAIT = 0.7  # s; an answer that takes longer waited for the robot
LEAST_WAIT = 1.8  # s before an answer may say that the robot did not confirm: 2 s, less what clocks differ by
WATCHED = 1.5  # s after an answer in which the motors would have followed it
_FROM_THE_LAST = "Keep the last robot_state, and answer from motors_enabled in it."
_SAID = {"Motors: ON": True, "Motors: OFF": False}


def on_status(call: Call, wanted: str) -> str:
    """Say what is wrong about an answer of get_status."""
    response = call.response
    if response.message == wanted:
        return "success tells whether the question could be answered, not whether the motors are on: set it to True."
    if response.message.strip().rstrip(".").lower() == wanted.lower():
        return f"The text is compared letter by letter, as a program would: {wanted!r}."
    if deaf := why_no_message_arrives(call.run, "robot_state"):
        return f"{deaf} {_FROM_THE_LAST}"
    if history := _history_of_the_status(call):
        return f"{history} {_FROM_THE_LAST}"
    if not response.success:
        return "Your node gets robot_state: look at each request whether a message has come."
    return f"Your node gets robot_state. {_FROM_THE_LAST}"


def _history_of_the_status(call: Call) -> str:
    """Return how get_status has answered so far: never another text, after the requests, or the opposite each time."""
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
        return "get_status said the opposite of the robot: true in motors_enabled means ON."
    asked_all = run.all(ev.ServiceCalled)
    requests = [(asked.t, asked.request.data) for asked in asked_all if asked.service == "enable_motors"]
    after = [(on, [data for asked_at, data in requests if asked_at < t][-1:]) for on, t in said]
    if any(asked for _on, asked in after) and all(asked in ([], [on]) for on, asked in after):
        return "get_status followed your last request, not the robot."
    if len({on for on, _t in said}) == 1 and len(said) > 1:
        return "get_status never changed, though the robot's motors did."
    return ""


def on_power(call: Call) -> str:
    """Say what the grader saw on motor_power."""
    run, wanted = call.run, call.request.data
    publish = f"Publish Bool(data=request.data) on motor_power when {question(call)} is granted."
    if seen := why_no_command_arrives(run, "motor_power", before=call.answered.t):
        return f"On motor_power the grader saw {seen}. {publish}"
    sent = [other.t for other in run.all(ev.ServiceCalled) if other.service == call.service]
    later = min((t for t in sent if t > call.sent.t), default=math.inf)
    received = [message for message in run.all(ev.MotorPowerReceived) if call.sent.t <= message.t < later]
    if not received:
        return f"On motor_power the grader saw no message after the request. {publish}"
    if received[-1].on is not wanted:
        return f"On motor_power the grader saw data: {shown(received[-1].on)}. {publish}"
    return f"On motor_power the right message came, but too late. {publish}"


def on_granting(call: Call, situation: str) -> str:
    """Say what is wrong about a refusal that had no reason."""
    if A_WAIT < call.latency < LEAST_WAIT:
        return f"It gave up waiting for robot_state after {call.latency:.1f} s: wait for 2 to 4 s."
    before, after = _had_power(call, call.sent.t), _had_power(call, call.answered.t + DELIVERY)
    if before is not call.request.data and after is call.request.data:
        return "The motors did as asked, but success is false: it says whether you grant the request, not what data is."
    if call.request.data:
        return "Never refuse power on: refuse only data: false, and only while the last robot_state.mode is WALKING."
    return f"Refuse power off only while the last robot_state.mode is WALKING: now it was {situation}."


def on_refusing(call: Call) -> str:
    """Say what is wrong about a granted request that should have been refused."""
    if _had_power(call, call.answered.t + WATCHED):
        if not call.response.message.strip():
            return "Nothing was switched off, but success is true: set response.success = False, and say why."
        return "Nothing was switched off, and the message refuses, but success is true: set response.success = False."
    if deaf := why_no_message_arrives(call.run, "robot_state"):
        return f"{deaf} Without it the node cannot know that the robot walks."
    return "Answer success: false, before you publish, when data is false and the last robot_state.mode is WALKING."


def _had_power(call: Call, t: float) -> bool | None:
    """Return whether the motors had power at a time (s), if that is known."""
    seen = [robot for robot in call.run.ground_truth if robot.t <= t]
    return seen[-1].motors_enabled if seen else None


def question(call: Call) -> str:
    """Name a request, as a person would ask it."""
    data = getattr(call.request, "data", None)
    return call.service if data is None else f"{call.service} (data: {shown(data)})"


def on_or_off(on: bool) -> str:
    """Return 'on' or 'off'."""
    return "on" if on else "off"
