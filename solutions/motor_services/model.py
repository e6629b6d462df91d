"""What must hold for every response of the motor services and every command to the motors, in every scenario."""

from __future__ import annotations

from itertools import pairwise

from autograder.authoring import (
    DELIVERY,
    Call,
    Failure,
    Transcript,
    answered_within,
    answers_without_waiting,
    calls,
    ev,
    lesson_on_subscribing,
    obligation,
    one_or_several,
    require_fastest,
    shown,
    shown_fields,
    whole_run,
)
from autograder.authoring.requirements.standard_obligations import (
    FROM_MEMORY,
    FROM_MEMORY_TIME,
    TOGETHER_TIME,
    enough_answers,
)
from ros_runtime.message_constants import RobotMode, name_of

from . import advice
from .advice import MIN_CONFIRMATION_WAIT, on_or_off, question

ENABLE, STATUS = "enable_motors", "get_status"
TEXTS = {True: "Motors: ON", False: "Motors: OFF"}
PERIOD = 0.3  # s, a little more than the period of robot_state
SAMPLE = 0.1  # s; the record samples the robot at 50 Hz, and robot_state is published on every change
COMMAND_TIMEOUT = 2.0  # s after the response, within which the command must reach the robot
IN_TIME = 2.0  # s for every response
UNCONFIRMED_TIMEOUT = 5.0  # s for a response that waits for a confirmation that does not come
CONFIRMED_TIME = FROM_MEMORY_TIME + PERIOD  # s for the fastest of several responses that wait for the robot
WALK_START_TIME = 3.0  # s


# -- what the node can know -------------------------------------------------------------------------------------------


def published_spans(run: Transcript) -> list[tuple[float, float]]:
    """Return the begin and end (s) of the times in which the robot published robot_state while the node ran."""
    verbs = [step[1] for step in run.params.get("steps", ()) if step[0] == "publish_state"]
    ready = run.first(ev.NodeReady)
    changes = [(event.t, event.command["published"]) for event in run.commands("robot_state")]
    begin = [(ready.t if ready else 0.0, not (verbs and verbs[0]))]
    return [
        (start, end)
        for (start, published), (end, _) in pairwise([*begin, *changes, (run.end, False)])
        if published
    ]


def last_states(call: Call) -> list[ev.RobotTruth] | None:
    """Return the states that the node's last robot_state may have had between request and response, oldest first.

    It is empty if certainly no robot_state had come, and None if that is uncertain.
    """
    end = call.answered.t + SAMPLE
    spans = [(start, stop) for start, stop in published_spans(call.run) if start <= call.answered.t]
    if not spans:
        return []
    arrived = [min(stop, call.sent.t - DELIVERY) for start, stop in spans if call.sent.t - DELIVERY >= start]
    heard = [at for at, (start, _) in zip(arrived, spans, strict=False) if at >= start + PERIOD]
    if not heard:
        return None
    return [
        robot
        for robot in call.run.robot_between(heard[-1] - SAMPLE, end)
        if any(start - SAMPLE <= robot.t <= stop + SAMPLE for start, stop in spans)
    ]


def _may_grant(call: Call) -> set[bool]:
    """Return the right decisions about the request: to accept (True), to reject (False), or both."""
    if call.request.data:
        return {True}
    states = last_states(call)
    if states and (commands := _commands(call)):
        # The server has decided before its command; what the command does to the robot is no reason for it.
        states = [robot for robot in states if robot.t < commands[0].t] or states
    return {robot.mode != RobotMode.WALKING for robot in states} if states else {True, False}


def _confirmed_at(call: Call) -> float | None:
    """Return when (s) a robot_state after the request first confirmed it, or None."""
    spans = published_spans(call.run)
    return next(
        (
            robot.t
            for robot in call.run.ground_truth
            if call.sent.t <= robot.t and robot.motors_enabled is call.request.data
            if any(start <= robot.t <= stop for start, stop in spans)
        ),
        None,
    )


def _waits_in_vain(call: Call) -> bool:
    """Return whether a response that waits for a confirmation by robot_state cannot come in time."""
    confirmed = _confirmed_at(call)
    return _may_grant(call) != {False} and (confirmed is None or confirmed > call.sent.t + IN_TIME - DELIVERY)


def _commands(call: Call) -> list[ev.MotorPowerReceived]:
    """Return the commands to the motors that the request may have caused."""
    end = call.answer.t + COMMAND_TIMEOUT if call.answer else call.run.end
    commands = call.run.all(ev.MotorPowerReceived)
    return [each for each in commands if each.on is call.request.data and call.sent.t <= each.t <= end]


def _was_not_confirmed(call: Call) -> bool:
    """Return whether the response may report that the robot did not confirm the command in time."""
    confirmed = _confirmed_at(call)
    return (
        call.latency >= MIN_CONFIRMATION_WAIT
        and bool(_commands(call))
        and (confirmed is None or call.answered.t < confirmed + DELIVERY)
    )


def _situation(call: Call) -> str:
    states = last_states(call)
    if not states:
        return "before the first robot_state"
    modes = dict.fromkeys(name_of(RobotMode, robot.mode) for robot in states)
    silent = not any(start <= call.sent.t <= stop for start, stop in published_spans(call.run))
    return "/".join(modes) + (", without new robot_state" if silent else "")


# -- power ------------------------------------------------------------------------------------------------------------


@obligation(1, 2, of=calls(ENABLE), see="02_services#set-file")
def grants_power_on(call: Call) -> str | None:
    """Power on is always accepted: success is true, and the command reaches the robot"""
    return _require_granted(call) if call.request.data else None


@obligation(1, 2, of=calls(ENABLE), see="02_services#set-file")
def grants_power_off(call: Call) -> str | None:
    """Power off is accepted unless the robot walks: success is true, and the command reaches the robot"""
    return _require_granted(call) if not call.request.data and _may_grant(call) == {True} else None


def _require_granted(call: Call) -> str:
    on = call.request.data
    when = f"while the robot is {_situation(call)}" if last_states(call) else _situation(call)
    call.require(
        call.response.success or _was_not_confirmed(call),
        expected=f"success: true for {question(call)} {when}",
        observed=shown_fields(call.response, "success", "message"),
        help=advice.on_granting(call, _situation(call)),
    )
    call.require(
        bool(_commands(call)),
        expected=f"{question(call)} to switch the robot's motors within {COMMAND_TIMEOUT:.0f} s of the response",
        observed=f"they were not switched {on_or_off(on)}, although the response had success true",
        help=advice.on_power(call),
    )
    return _situation(call)


@obligation(2, of=calls(ENABLE), see="02_services#set-refuse-why")
def refuses_power_off(call: Call) -> str | None:
    """While the robot walks, power off is rejected: success is false, and the message gives the reason"""
    if (may := _may_grant(call)) == {True}:
        return None
    if may == {False}:
        call.expect(
            "success",
            False,
            because="the robot was WALKING when power off was requested",
            help=advice.on_refusing(call),
        )
    elif call.response.success:
        return None
    call.require(
        bool(call.response.message.strip()),
        expected="a message that says why power off is rejected",
        observed="an empty message",
        help='Set response.message, for example to "the robot is walking: stop it first".',
    )
    return _situation(call)


@obligation(1, 2, of=whole_run)
def commands_only_what_was_granted(run: Transcript) -> str:
    """On motor_power only accepted requests are published, nothing for rejected ones, and nothing later"""
    asked = calls(ENABLE)(run)
    for command in run.all(ev.MotorPowerReceived):
        causes = [call for call in asked if command in _commands(call)]
        if any(
            call.answer is None
            or call.response.success
            or (True in _may_grant(call) and _was_not_confirmed(call))
            for call in causes
        ):
            continue
        when = "before any request"
        if before := causes or [call for call in asked if call.sent.t <= command.t]:
            when = f"{command.t - before[-1].sent.t:.1f} s after {question(before[-1])}"
        raise Failure(
            expected="only accepted requests published on motor_power",
            observed=f"motor_power: {shown(command.on)} {when}" + (", which was rejected" if causes else ""),
            help="When you accept a request, publish its data at once; when you reject it, publish nothing.",
            at=command.t,
        )
    return "commands" if run.all(ev.MotorPowerReceived) else "no command"


@obligation(2, of=whole_run)
def lets_it_walk(run: Transcript) -> str | None:
    """A walking robot walks on, whatever requests the node receives"""
    told = [each for each in run.all(ev.RobotCommanded) if each.command.get("do") != "robot_state"]
    judged = False
    for number, event in enumerate(told):
        if event.command.get("do") != "walk" or not any(event.command["velocity"]):
            continue
        end = min([later.t for later in told[number + 1 :]] + [run.end]) - SAMPLE
        seen = [robot for robot in run.ground_truth if event.t <= robot.t <= end]
        began = next((robot.t for robot in seen if robot.mode == RobotMode.WALKING), None)
        if began is None and end < event.t + WALK_START_TIME:
            continue
        idle: ev.RobotTruth | None = seen[-1]
        if began is not None:
            idle = next((each for each in seen if each.t >= began and each.mode != RobotMode.WALKING), None)
        asked = [call for call in calls(ENABLE)(run) if event.t < call.sent.t <= (idle.t if idle else end)]
        after = f" after {question(asked[-1])}" if asked else ""
        if idle:
            raise Failure(
                expected=f"the robot to walk on as commanded{after}",
                observed=f"it is {name_of(RobotMode, idle.mode)}, and its motors are {on_or_off(idle.motors_enabled)}",
                help="Publish on motor_power only when you accept a request, and never on cmd_vel.",
                at=idle.t,
            )
        judged = judged or bool(asked)
    return "walking" if judged else None


# -- status -----------------------------------------------------------------------------------------------------------


@obligation(3, 4, of=calls(STATUS), see="02_services#first-file")
def tells_the_motors(call: Call) -> str | None:
    """get_status responds with success true and exactly the text for motors_enabled in the last robot_state"""
    states = last_states(call)
    if not states:
        return None
    possible = {robot.motors_enabled for robot in states}
    wanted = TEXTS[states[-1].motors_enabled]
    call.require(
        call.response.success and call.response.message in [TEXTS[on] for on in possible],
        expected=f"success: true, message: {wanted!r}, as in the last robot_state the motors are "
        f"{on_or_off(states[-1].motors_enabled)} and the robot is {_situation(call)}",
        observed=shown_fields(call.response, "success", "message"),
        help=advice.on_status(call, wanted),
        see=lesson_on_subscribing(call.run, "robot_state"),
    )
    return _situation(call) if len(possible) == 1 else "while they are switched"


@obligation(4, of=calls(STATUS))
def says_when_it_knows_nothing(call: Call) -> str | None:
    """Before the first robot_state get_status responds with success false and neither of the two texts"""
    if last_states(call) != []:
        return None
    response = call.response
    call.require(
        not response.success and response.message.strip(" .").lower() not in map(str.lower, TEXTS.values()),
        expected="success: false and a message with neither ON nor OFF, as no robot_state has come yet",
        observed=shown_fields(response, "success", "message"),
        help="Initialise the stored message with None, and set success to false while it is None."
        if response.success
        else "Write into message that the status is unknown, neither ON nor OFF.",
    )
    return "before the first robot_state"


# -- time -------------------------------------------------------------------------------------------------------------


def _knowledge(call: Call) -> str:
    if not last_states(call):
        return "before the first robot_state"
    power = [asked.t for asked in call.run.all(ev.ServiceCalled) if asked.service == ENABLE]
    together = any(0 <= call.sent.t - t < TOGETHER_TIME for t in power)
    return "together with enable_motors" if together else "alone"


status_in_time = answered_within(IN_TIME, STATUS, clause=5)
status_from_memory = answers_without_waiting(STATUS, _knowledge, clause=5)


@obligation(5, of=calls(ENABLE))
def power_in_time(call: Call) -> str:
    """Every request for power gets a response within 2 s; within 5 s if the robot does not confirm it"""
    waits = _waits_in_vain(call)
    limit = UNCONFIRMED_TIMEOUT if waits else IN_TIME
    call.require(
        call.latency <= limit,
        expected=f"a response to {question(call)} within {limit:g} s",
        observed=f"the response to {_which(call)} took {call.latency:.2f} s",
        help="Publish and return the response: do not sleep in the callback, as other callbacks need its thread."
        if not waits
        else "The robot does not confirm this request. If the callback sleeps, remove that, as no other callback runs "
        "meanwhile; if it awaits robot_state, give that a timeout, and report it in the response.",
    )
    return one_or_several(call)


def _which(call: Call) -> str:
    """Return which of the run's requests to the service a call is: "request 2 of 5"."""
    asked = [each.sent.call for each in call.run.calls if each.service == call.service]
    return f"request {asked.index(call.sent.call) + 1} of {len(asked)}"


def _kind(call: Call) -> str | None:
    if _may_grant(call) == {False}:
        return "rejected"
    return None if _waits_in_vain(call) else "accepted"


@obligation(5, of=whole_run)
def power_never_sleeps(run: Transcript) -> str | None:
    """The callback never sleeps: it responds from memory, or waits only for the next robot_state"""
    judged = enough_answers(calls(ENABLE)(run), _kind)
    for kind, each in judged.items():
        limit = FROM_MEMORY_TIME if kind == "rejected" else CONFIRMED_TIME
        expected = f"the response to a {kind} request to {ENABLE} without a sleep"
        require_fastest(each, limit, expected=expected, help=FROM_MEMORY)
    return ", ".join(sorted(judged)) or None


@obligation(6, of=whole_run, see="01_robot_and_graph#names-why")
def serves_the_robot(run: Transcript) -> str | None:
    """All names are relative: the services work with the robot in the node's namespace"""
    judged = all(each.judge(run) for each in (grants_power_off, tells_the_motors, grants_power_on))
    return "another namespace" if judged else None
