"""What must hold of every set of gains, of all that is published, and of the robot, clause by clause."""

from __future__ import annotations

import math

from rcl_interfaces.msg import ParameterDescriptor, ParameterType

from autograder.authoring import (
    Call,
    Failure,
    Obligation,
    Transcript,
    calls,
    ev,
    expect,
    obligation,
    require_alive,
    require_failure,
    require_ready,
    require_within_limits,
    whole_run,
)
from ros_runtime.message_constants import RobotMode

from . import advice, gains, record
from .record import PUBLISH_TIME, SERVICES, TOPIC, Batch, Change, Reading, changes_before, readings

NEAR_DEFAULT = 1.0  # the robot's own gains are not whole numbers
AFTERMATH = 3.0  # s after a push in which a robot falls if it does
GIVING_UP = 12.0  # s for a program to refuse what it is started with
_TYPES = {
    ParameterType.PARAMETER_NOT_SET: "none: it is not declared, or without a default",
    ParameterType.PARAMETER_INTEGER: "an integer",
}
DESCRIBE = f"{SERVICES}describe_parameters"


# -- the parameters ---------------------------------------------------------------------------------------------------


@obligation(of=whole_run, see="10_parameters_and_balance#circle-why")
def offers_its_parameters(run: Transcript) -> str:
    """The node offers its parameters, as the node balance_controller"""
    require_ready(run)
    for call in run.calls[:1]:
        _ = call.answered  # rclpy offers them before the constructor is at its end, where a node may fail
    return "its parameters"


@obligation(1, 12, of=readings, see="10_parameters_and_balance#circle-why")
def has_its_gains(reading: Reading) -> str:
    """The five parameters are doubles, at first the robot's own gains, or those that the node was started with"""
    started_with = reading.call.run.params.get("started_with", {})
    for name, default in gains.DEFAULTS.items():
        reading.call.require(
            reading.parameters[name].type == ParameterType.PARAMETER_DOUBLE,
            expected=f"a parameter {name} of type double",
            observed=_TYPES.get(reading.parameters[name].type, "another type"),
            help=f"Declare it with a float as its default: self.declare_parameter({name!r}, {default}, …).",
        )
        wanted, near, whose = default, NEAR_DEFAULT, "the robot's own"
        if name in started_with:
            wanted, near, whose = started_with[name], 0.0, "as it was started with"
        reading.call.require(
            bool(reading.before) or math.isclose(reading.gains[name], wanted, rel_tol=1e-6, abs_tol=near),
            expected=f"{name} {wanted:g}, {whose}",
            observed=f"{reading.gains[name]:g}",
            help="Declare each parameter with the default of the task's table, and set nothing: rclpy does the rest.",
        )
    return "later" if reading.before else "started with some" if started_with else "defaults"


@obligation(2, of=calls(DESCRIBE), see="10_parameters_and_balance#circle-why")
def describes_each(call: Call) -> str:
    """Each parameter has a description and a range that holds its default"""
    described = iter(call.response.descriptors)
    for name in gains.NAMES:
        descriptor = next(described, ParameterDescriptor())
        call.require(
            bool(descriptor.description.strip()),
            expected=f"a description of {name}",
            observed="none",
            help="Give declare_parameter a ParameterDescriptor with a description: what the gain does, in which unit.",
        )
        ranges = descriptor.floating_point_range
        call.require(
            any(one.from_value < gains.DEFAULTS[name] <= one.to_value for one in ranges),
            expected=f"a floating_point_range of {name} that holds {gains.DEFAULTS[name]:g}",
            observed=", ".join(f"{one.from_value:g} to {one.to_value:g}" for one in ranges) or "none",
            help="Give the descriptor floating_point_range=[FloatingPointRange(from_value=…, to_value=…)], a list.",
        )
    return "all five"


def _refuses(sentence: str, *faults: str, clause: int = 3) -> Obligation:
    """Make the obligation that a set is refused in which a value has one of these faults."""

    def refuses(change: Change) -> str | None:
        fault = next((each for each in change.faults.values() if each in faults), None)
        if fault is None:
            return None
        change.call.require(
            not change.accepted,
            expected=f"{change.words} is refused: {advice.REFUSALS[fault][0]}",
            observed="accepted",
            help=advice.about_accepting(change, fault),
        )
        return f"{fault}, {'alone' if len(change.values) == 1 else 'among others'}"

    refuses.__doc__ = sentence
    return obligation(clause, of=record.changes)(refuses)


refuses_weak_gains = _refuses("A kp of less than 51 N·m/rad is refused", gains.TOO_WEAK)
refuses_negative_gains = _refuses("A negative gain is refused", gains.NEGATIVE)
refuses_no_numbers = _refuses("NaN and infinity are refused", gains.NOT_FINITE)
refuses_limits = _refuses("A kp of exactly 51 N·m/rad and a max_torque of 0 are refused", gains.LIMIT)
takes_no_integer_for_a_double = _refuses("An integer for a double is refused", gains.INTEGER, clause=4)


@obligation(5, of=record.changes)
def gives_a_reason(change: Change) -> str | None:
    """Every refusal has a reason"""
    if change.accepted:
        return None
    change.call.require(
        bool(change.reason.strip()),
        expected=f"a reason why {change.words} is refused",
        observed="an empty reason",
        help='Give SetParametersResult a reason, too: "kp_pitch is 40.0; it has to be above 51.0".',
    )
    return "refused"


@obligation(6, of=record.changes, see="10_parameters_and_balance#push-why")
def accepts_the_table(change: Change) -> str | None:
    """All other values of the table are accepted"""
    if change.faults or any(value > gains.HIGHEST[name] for name, value in change.values.items()):
        return None
    change.call.require(
        change.accepted,
        expected=f"{change.words} is accepted: it is within the ranges",
        observed=f"refused: {change.reason or 'without a reason'}",
        help=advice.about_refusing(change),
    )
    return "one" if len(change.values) == 1 else "several together"


@obligation(9, 10, of=readings)
def has_what_it_accepted(reading: Reading) -> str | None:
    """The parameters have the values that were accepted, and nothing of a set that was refused"""
    if not reading.before:
        return None
    last, found = reading.before[-1], reading.gains
    wrong = _wrong(found, last.after)
    reading.call.require(
        not wrong,
        expected=f"the parameters {gains.in_words(last.after, wrong)}, as they were accepted",
        observed=gains.in_words(found, wrong),
        help="Leave setting to rclpy: what an on-set callback sets itself may still be refused.",
    )
    how = "accepted" if last.accepted else "refused"
    return f"{how}, {'one' if len(last.values) == 1 else 'several together'}"


# -- what it publishes ------------------------------------------------------------------------------------------------


@obligation(7, of=record.batches)
def publishes_them_in_time(batch: Batch) -> str | None:
    """After each accepted set, balance_gains has all five gains as they are then, within 1 s"""
    if not batch.accepted:
        return None
    run, last, old = batch.run, batch.accepted[-1], batch.changes[0].before
    words = f"{'; '.join(change.words for change in batch.accepted)} was accepted"
    if batch.messages:
        _require_gains(batch.messages[-1], last.after, old=old, after=words)
    else:
        require_alive(run)
    answered = batch.changes[-1].call.answered.t
    since = [event for event in run.received(TOPIC) if event.t >= batch.changes[0].call.sent.t]
    right = [event.t for event in since if not _wrong(_gains_in(event), last.after)]
    help, see = advice.about_silence(run, is_late=bool(right), changes_something=last.after != old)
    expect(
        bool(right) and right[0] <= answered + PUBLISH_TIME,
        expected=f"a message on {TOPIC} within 1 s, because {words}",
        observed=f"it came {right[0] - answered:.1f} s later" if right else "none",
        help=help,
        at=answered,
        see=see,
    )
    return "nothing new" if last.after == old else "new gains"


@obligation(8, of=record.batches, see="10_parameters_and_balance#atomic-why")
def one_message_each(batch: Batch) -> str | None:
    """Each accepted set has one message, with the gains as they were then"""
    accepted, messages = batch.accepted, batch.messages
    if not accepted:
        return None
    if len(messages) >= len(accepted):  # else their values would be compared with those of other sets
        for change, message in zip(accepted, messages, strict=False):
            _require_gains(message, change.after, old=change.before, after=f"{change.words} was accepted")
    expect(
        len(messages) == len(accepted),
        expected=f"one message on {TOPIC} for each of: {'; '.join(change.words for change in accepted)}",
        observed=f"{len(messages)} in all",
        help=advice.about_number(len(messages), accepted),
        at=messages[-1].t if messages else accepted[-1].call.answered.t,
    )
    several = "several at once" if len(batch.changes) > 1 else "one"
    return f"{several}, one refused" if len(accepted) < len(batch.changes) else several


@obligation(9, of=record.batches, see="10_parameters_and_balance#book-why")
def says_nothing_when_it_refuses(batch: Batch) -> str | None:
    """Nothing is published for a set that is refused"""
    if batch.accepted:
        return None
    if batch.messages:
        event = batch.messages[0]
        raise Failure(
            expected=f"nothing on {TOPIC}, because {batch.changes[0].words} was refused",
            observed=gains.in_words(_gains_in(event)),
            help="An on-set callback only says yes or no: publish in the post-set callback.",
            at=event.t,
        )
    return "refused" if len(batch.changes[0].values) == 1 else "refused together"


@obligation(9, of=whole_run)
def publishes_only_what_was_accepted(run: Transcript) -> str | None:
    """Each gain in each message is one that was accepted before, or of the start"""
    first, heard = record.gains_at_first(run), run.received(TOPIC)
    accepted = [change for change in record.changes(run) if change.accepted]
    for event in heard:
        sent = [change.after for change in accepted if change.call.sent.t <= event.t]
        wrongs = [_wrong(_gains_in(event), each) for each in (first, *sent)]
        wrong = [name for name in gains.NAMES if all(name in each for each in wrongs)]
        expect(
            not wrong,
            expected=f"{TOPIC} with gains that were accepted",
            observed=f"{gains.in_words(_gains_in(event), wrong)}, which never was",
            help=advice.KEEP_NO_COPY,
            at=event.t,
        )
    return "all messages" if heard else None


def _listeners(run: Transcript) -> list[tuple[Transcript, str, float]]:
    """Occasions: each robot that starts late, with its name and when (s) it began to listen."""
    names = [step[1] for step in run.params.get("steps", ()) if step[0] == "listen"]
    return [(run, name, run.mark(name)) for name in names]


@obligation(11, of=_listeners, see="01_robot_and_graph#late-why")
def keeps_the_last(occasion: tuple[Transcript, str, float]) -> str:
    """A robot that starts later gets the last message, because the topic is latched"""
    run, name, began = occasion
    heard = run.received(name)
    require_alive(run)
    expect(
        bool(heard),
        expected=f"the last message of {TOPIC} at a node that subscribes later",
        observed="none",
        help="Give the publisher QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL) instead of 10.",
        at=began,
    )
    _require_gains(
        heard[0], record.gains_at(run, heard[0].t), old=gains.DEFAULTS, after="these were accepted before"
    )
    return "after sets" if changes_before(run, began) else "at first"


@obligation(12, of=whole_run)
def publishes_its_start_once(run: Transcript) -> str | None:
    """At the start it publishes its gains once, with the values that it was started with"""
    if not run.params.get("latched"):
        return None  # of what is published before anybody is there, only a latched message arrives
    first_set = min((change.call.sent.t for change in record.changes(run)), default=math.inf)
    heard = [event for event in run.received(TOPIC) if event.t < first_set]
    expect(
        len(heard) == 1,
        expected=f"1 message on {TOPIC} at the start",
        observed=f"{len(heard)}",
        help="Publish once, from no timer, at the end of the constructor: each declaration before it is a set, too.",
        at=heard[-1].t if heard else run.end,
    )
    _require_gains(heard[0], record.gains_at_first(run), old=gains.DEFAULTS, after="these are its parameters")
    return "started with some" if run.params.get("started_with") else "defaults"


# -- the node and the robot -------------------------------------------------------------------------------------------


@obligation(13, of=whole_run, see="10_parameters_and_balance#late-why")
def refuses_to_start(run: Transcript) -> str:
    """Started with a value that it would refuse, the program ends with status 1 and a line on stderr"""
    require_within_limits(run)
    name, value = run.params["name"], run.params["value"]
    if run.first(ev.NodeExited) is None:
        raise Failure(
            expected=f"a program that ends with status 1 when it is started with {name}:={value}",
            observed=f"it still runs; the last line on stderr: {run.last_words or 'none'}",
            help="It knows of the bad value and goes on: return 1 from main() instead."
            if name in run.output("stderr")
            else "Declaring sets the values from the start: register the on-set callback before you declare.",
            at=run.end,
        )
    require_failure(run, GIVING_UP, f"it was started with {name}:={value}")
    return f"{name}:={value}"


@obligation(14, of=whole_run)
def survives(run: Transcript) -> str | None:
    """With the gains that it publishes the robot survives a push of 10 N·s"""
    pushed = run.last_command("push").t
    if not gains.hold_the_robot(record.gains_at(run, pushed)):
        return None
    watched = run.robot_between(pushed, pushed + AFTERMATH)
    fallen = next((robot.t for robot in run.ground_truth if robot.mode == RobotMode.FALLEN), None)
    off = [event.t for event in run.all(ev.MotorPowerReceived) if not event.on]
    off += [robot.t for robot in watched if not robot.motors_enabled]
    at = pushed if fallen is None else fallen
    heard = [event for event in run.received(TOPIC) if event.t <= at]
    how = "its motors were switched off" if fallen is None else f"it fell at {fallen:.1f} s"
    expect(
        fallen is None and not off,
        expected="a robot that stays on its feet, its motors on, because gains that can never hold it are refused",
        observed=f"{how}; it was pushed at {pushed:.1f} s; the last on {TOPIC} before: "
        + (gains.in_words(_gains_in(heard[-1])) if heard else "nothing at all"),
        help="Somebody switched its motors off: publish nothing but balance_gains."
        if off
        else "Compare these gains with the table of the task, and refuse in the on-set callback what is not in it.",
        at=at,
    )
    return "other gains" if changes_before(run, pushed) else "defaults"


# -- messages ---------------------------------------------------------------------------------------------------------


def _gains_in(event: ev.MessageReceived) -> dict[str, float]:
    return {name: getattr(event.message, name) for name in gains.NAMES}


def _wrong(found: gains.Gains, wanted: gains.Gains) -> list[str]:
    """Name the gains that differ by more than a float's rounding."""
    return [
        name
        for name in gains.NAMES
        if not math.isclose(found[name], wanted[name], rel_tol=1e-6, abs_tol=1e-6)
    ]


def _require_gains(event: ev.MessageReceived, wanted: gains.Gains, *, old: gains.Gains, after: str) -> None:
    """Require that a message holds these gains; `old` are those of before the set, `after` what had happened."""
    found = _gains_in(event)
    if wrong := _wrong(found, wanted):
        raise Failure(
            expected=f"{TOPIC} with {gains.in_words(wanted, wrong)}, because {after}",
            observed=gains.in_words(found, wrong),
            help=advice.about_values(found, wanted, old, wrong),
            at=event.t,
        )
