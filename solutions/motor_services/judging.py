"""Compares answers of the motor services with the motors of the simulated robot."""

from __future__ import annotations

import math

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.connections import lesson_on_hearing, why_nothing_is_commanded, why_nothing_is_heard
from autograder.authoring.failure import expect
from autograder.authoring.fields import shown, shown_fields
from autograder.authoring.robot_record import RobotRecord
from autograder.authoring.robot_topic import DELIVERY
from ros_runtime.message_constants import RobotMode, name_of

OBEYED = 2.0  # s after the answer in which the motors must be as asked
WATCHED = 1.5  # s after the answer in which the robot must walk on
_SAID = {"Motors: ON": True, "Motors: OFF": False}

_NOTHING_UNASKED = "Publish nothing unasked: motor_power only when a request is granted, and cmd_vel never."


def require_status(call: Call, on: bool) -> None:
    """Require that the answer tells the state of the robot's motors, which has not changed for a while."""
    _require_motors_known(call, on)
    response, wanted = call.response, f"Motors: {_on_or_off(on).upper()}"
    expect(
        response.success and response.message == wanted,
        expected=f"success: true, message: {wanted!r}; the robot's motors are {_on_or_off(on)}",
        observed=shown_fields(response, "success", "message"),
        help=_advice_on_status(call, wanted),
        at=call.answered.t,
        see=lesson_on_hearing(call.run, "robot_state"),
    )


def require_status_after_a_change(call: Call, on: bool) -> None:
    """Require that the answer tells the state of the motors after the scenario has switched them."""
    call.run.told("motor_power", before=call.sent.t - DELIVERY, on=on)
    require_status(call, on)


def require_granted(call: Call) -> None:
    """Require that the request was answered with success, and that the motors soon follow it."""
    run, on = call.run, call.request.data
    expect(
        call.response.success,
        expected=f"success: true to {_question(call)} while the robot is {_mode(run, call.sent.t)}",
        observed=shown_fields(call.response, "success", "message"),
        help=_advice_on_granting(call),
        at=call.answered.t,
    )
    end = min(call.answered.t + OBEYED, _next_question(call), run.end)
    last = run.robot_between(call.sent.t, max(end, call.answered.t + DELIVERY))[-1]
    expect(
        last.motors_enabled is on,
        expected=f"the robot's motors {_on_or_off(on)} within {OBEYED:.0f} s of the answer to {_question(call)}",
        observed=f"they are {_on_or_off(not on)}, though the answer was success",
        help=_advice_on_power(call),
        at=last.t,
    )


def require_switched(call: Call) -> None:
    """Require that the request was granted and changed the state of the motors."""
    on = call.request.data
    expect(
        call.run.robot_at(call.sent.t).motors_enabled is not on,
        expected=f"the robot's motors {_on_or_off(not on)} until {_question(call)} is asked for",
        observed=f"they are {_on_or_off(on)} before",
        help="Publish on motor_power only when a request is granted.",
        at=call.sent.t,
    )
    require_granted(call)


def require_refused(call: Call) -> None:
    """Require that power off was refused with a sentence, and that the robot walked on."""
    answered = call.answered
    require_walking_as_told(call)
    call.expect(
        "success",
        False,
        because="the robot was WALKING when power off was asked for",
        help=_advice_on_refusing(call),
    )
    expect(
        bool(call.response.message.strip()),
        expected="a message that says why power off is refused",
        observed="an empty message",
        help='Set response.message, for example to "the robot is walking: stop it first".',
        at=answered.t,
    )
    require_walking_on(call)


def require_walking_as_told(call: Call) -> None:
    """Require that the robot walked when the question came, and had for long enough that the node knew."""
    told = call.run.told("walk", before=call.sent.t - DELIVERY)
    watched = call.run.robot_between(call.sent.t - DELIVERY, call.sent.t)
    idle = next((robot for robot in watched if robot.mode != RobotMode.WALKING), None)
    expect(
        idle is None and any(told.command["velocity"]),
        expected="the robot walking when power off is asked for, as it was told",
        observed=f"it is {_mode(call.run, idle.t if idle else call.sent.t)}",
        help=_NOTHING_UNASKED,
        at=call.sent.t,
    )


def require_standing_as_told(call: Call) -> None:
    """Require that the robot was told to stop, and stood when the question came, for long enough that the node knew."""
    call.run.told("walk", before=call.sent.t - DELIVERY, velocity=[0.0, 0.0, 0.0])
    watched = call.run.robot_between(call.sent.t - DELIVERY, call.sent.t)
    expect(
        all(robot.mode != RobotMode.WALKING for robot in watched),
        expected="the robot standing when power off is asked for again, as it was told",
        observed=f"it is {_mode(call.run, call.sent.t)}",
        help=_NOTHING_UNASKED,
        at=call.sent.t,
    )


def require_walking_on(call: Call) -> None:
    """Require that the motors kept their power, and the robot still walks a while after the answer."""
    watched = call.run.robot_between(call.sent.t, call.answered.t + WATCHED)
    last = next((robot for robot in watched if not robot.motors_enabled), watched[-1])
    expect(
        last.motors_enabled and last.mode == RobotMode.WALKING,
        expected=f"the robot walking on after {_question(call)}",
        observed=f"it is {name_of(RobotMode, last.mode)}, its motors are {_on_or_off(last.motors_enabled)}",
        help="Return before anything is published when a request is refused; where it is granted, publish what "
        "data says.",
        at=last.t,
    )


def _require_motors_known(call: Call, on: bool) -> None:
    """Require that the motors have not changed for long enough that the node knew."""
    watched = call.run.robot_between(call.sent.t - DELIVERY, call.sent.t)
    other = next((robot for robot in watched if robot.motors_enabled is not on), None)
    expect(
        other is None,
        expected=f"the robot's motors {_on_or_off(on)} when {_question(call)} is asked",
        observed=f"they are {_on_or_off(not on)}",
        help="Publish on motor_power when a request is granted, at once, and never else.",
        at=other.t if other else None,
    )


def _next_question(call: Call) -> float:
    """Return when the next request for the motors was sent (s): from then on they may change again."""
    sent = [other.t for other in call.run.all(ev.ServiceCalled) if other.service == call.service]
    return min((t for t in sent if t > call.sent.t), default=math.inf)


def _advice_on_status(call: Call, wanted: str) -> str:
    response = call.response
    if response.message == wanted:
        return "success tells whether the question could be answered, not whether the motors are on: set it to True."
    if response.message.strip().rstrip(".").lower() == wanted.lower():
        return f"The text is compared letter by letter, as a program would: {wanted!r}."
    if deaf := why_nothing_is_heard(call.run, "robot_state"):
        return (
            f"{deaf} Subscribe to robot_state, keep the last message, and answer from motors_enabled in it."
        )
    if history := _history_of_the_status(call.run):
        return (
            f"{history} Answer from motors_enabled of the last robot_state, not from the first one or a flag."
        )
    if not response.success:
        return (
            "Your node gets robot_state, but still says that it knows nothing: look at each request whether a message "
            "has come."
        )
    return "Your node gets robot_state: keep its last message, and answer from motors_enabled in it."


def _history_of_the_status(run: RobotRecord) -> str:
    """Return how get_status has answered so far: never another text, after the requests, or the opposite each time."""
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
    requests = [
        (asked.t, asked.request.data)
        for asked in run.all(ev.ServiceCalled)
        if asked.service == "enable_motors"
    ]
    after = [(on, [data for asked_at, data in requests if asked_at < t][-1:]) for on, t in said]
    if any(asked for _on, asked in after) and all(asked in ([], [on]) for on, asked in after):
        return "get_status followed your last request, not the robot."
    if len({on for on, _t in said}) == 1 and len(said) > 1:
        return "get_status never changed, though the robot's motors did."
    return ""


def _advice_on_power(call: Call) -> str:
    """Say what the grader saw on motor_power."""
    run, wanted = call.run, call.request.data
    publish = f"Publish Bool(data=request.data) on motor_power when {_question(call)} is granted."
    if seen := why_nothing_is_commanded(run, "motor_power", before=call.answered.t):
        return f"On motor_power the grader saw {seen}. {publish}"
    later = _next_question(call)
    received = [message for message in run.all(ev.MotorPowerReceived) if call.sent.t <= message.t < later]
    if not received:
        return f"On motor_power the grader saw no message after the request. {publish}"
    if received[-1].on is not wanted:
        return f"On motor_power the grader saw data: {shown(received[-1].on)}. {publish}"
    return f"On motor_power the right message came, but too late. {publish}"


def _advice_on_granting(call: Call) -> str:
    """Say what is wrong about a refusal that had no reason."""
    before, after = _had_power(call, call.sent.t), _had_power(call, call.answered.t + DELIVERY)
    if before is not call.request.data and after is call.request.data:
        return "The motors did as asked, but success is false: it says whether you grant the request, not what data is."
    if call.request.data:
        return "Never refuse power on: refuse only data: false, and only while the last robot_state.mode is WALKING."
    return (
        "Refuse power off only while the mode in the last robot_state is RobotState.WALKING: now it was "
        f"{_mode(call.run, call.sent.t)}."
    )


def _advice_on_refusing(call: Call) -> str:
    """Say what is wrong about a granted request that should have been refused."""
    if _had_power(call, call.answered.t + WATCHED):
        if not call.response.message.strip():
            return "Nothing was switched off, but success is true: set response.success = False, and say why."
        return "Nothing was switched off, and the message refuses, but success is true: set response.success = False."
    if deaf := why_nothing_is_heard(call.run, "robot_state"):
        return f"{deaf} Without it the node cannot know that the robot walks."
    return "Answer success: false, before you publish, when data is false and the last robot_state.mode is WALKING."


def _had_power(call: Call, t: float) -> bool | None:
    """Return whether the motors had power at a time (s), if that is known."""
    seen = [robot for robot in call.run.ground_truth if robot.t <= t]
    return seen[-1].motors_enabled if seen else None


def _question(call: Call) -> str:
    data = getattr(call.request, "data", None)
    return call.service if data is None else f"{call.service} (data: {shown(data)})"


def _mode(run: RobotRecord, t: float) -> str:
    return name_of(RobotMode, run.robot_at(t).mode)


def _on_or_off(on: bool) -> str:
    return "on" if on else "off"
