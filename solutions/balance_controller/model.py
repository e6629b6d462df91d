"""What must hold for every set of gains, every published message, and the robot, clause by clause."""

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

DEFAULT_SLACK = 1.0  # in the gain's unit; the robot's own gains are not whole numbers
FALL_TIME = 3.0  # s after a push, within which a robot falls if it does not survive the push
EXIT_TIMEOUT = 12.0  # s for a program to exit when it is started with an invalid value
_TYPES = {
    ParameterType.PARAMETER_NOT_SET: "not set: it is not declared, or has no default",
    ParameterType.PARAMETER_INTEGER: "an integer",
}
DESCRIBE = f"{SERVICES}describe_parameters"


# -- the parameters ---------------------------------------------------------------------------------------------------


@obligation(of=whole_run, see="10_parameters_and_balance#circle-why")
def offers_its_parameters(run: Transcript) -> str:
    """The node balance_controller offers its parameters"""
    require_ready(run)
    for call in run.calls[:1]:
        # rclpy offers the services before the constructor has finished, which may still fail
        _ = call.answered
    return "its parameters"


@obligation(1, 12, of=readings, see="10_parameters_and_balance#circle-why")
def has_its_gains(reading: Reading) -> str:
    """The five parameters are doubles, at first the robot's own gains or those with which the node was started"""
    started_with = reading.call.run.params.get("started_with", {})
    for name, default in gains.DEFAULTS.items():
        reading.call.require(
            reading.parameters[name].type == ParameterType.PARAMETER_DOUBLE,
            expected=f"a parameter {name} of type double",
            observed=_TYPES.get(reading.parameters[name].type, "another type"),
            help=f"Declare it with a float as its default: self.declare_parameter({name!r}, {default}, …).",
        )
        wanted, near, whose = default, DEFAULT_SLACK, "the robot's own gain"
        if name in started_with:
            wanted, near, whose = started_with[name], 0.0, "the value with which the node was started"
        reading.call.require(
            bool(reading.before) or math.isclose(reading.gains[name], wanted, rel_tol=1e-6, abs_tol=near),
            expected=f"{name} {wanted:g}, {whose}",
            observed=f"{reading.gains[name]:g}",
            help="Declare each parameter with the default of the task's table, and do not set it yourself: rclpy "
            "applies the values from the command line.",
        )
    return "later" if reading.before else "started with values" if started_with else "defaults"


@obligation(2, of=calls(DESCRIBE), see="10_parameters_and_balance#circle-why")
def describes_each(call: Call) -> str:
    """Each parameter has a description, and a range that contains its default"""
    described = iter(call.response.descriptors)
    for name in gains.NAMES:
        descriptor = next(described, ParameterDescriptor())
        call.require(
            bool(descriptor.description.strip()),
            expected=f"a description of {name}",
            observed="no description",
            help="Give declare_parameter a ParameterDescriptor whose description says what the gain does, in which "
            "unit.",
        )
        ranges = descriptor.floating_point_range
        call.require(
            any(one.from_value < gains.DEFAULTS[name] <= one.to_value for one in ranges),
            expected=f"a floating_point_range of {name} that contains {gains.DEFAULTS[name]:g}",
            observed=", ".join(f"{one.from_value:g} to {one.to_value:g}" for one in ranges) or "no range",
            help="Give the descriptor a list: floating_point_range=[FloatingPointRange(from_value=…, to_value=…)].",
        )
    return "all five"


def _rejects(sentence: str, *faults: str, clause: int = 3) -> Obligation:
    """Make the obligation that a set is rejected if a value has one of these faults."""

    def rejects(change: Change) -> str | None:
        fault = next((each for each in change.faults.values() if each in faults), None)
        if fault is None:
            return None
        change.call.require(
            not change.accepted,
            expected=f"{change.words} rejected, because {advice.REJECTIONS[fault][0]}",
            observed="accepted",
            help=advice.about_accepting(change, fault),
            see="10_parameters_and_balance#circle-why" if fault == gains.LIMIT else "",
        )
        return f"{fault}, {'alone' if len(change.values) == 1 else 'among others'}"

    rejects.__doc__ = sentence
    return obligation(clause, of=record.changes)(rejects)


refuses_weak_gains = _rejects("A kp of less than 51 N·m/rad is rejected", gains.TOO_WEAK)
refuses_negative_gains = _rejects("A negative gain is rejected", gains.NEGATIVE)
refuses_no_numbers = _rejects("NaN and infinity are rejected", gains.NOT_FINITE)
refuses_limits = _rejects("A kp of exactly 51 N·m/rad and a max_torque of 0 are rejected", gains.LIMIT)
takes_no_integer_for_a_double = _rejects("An integer for a double is rejected", gains.INTEGER, clause=4)


@obligation(5, of=record.changes)
def gives_a_reason(change: Change) -> str | None:
    """Every rejection has a reason"""
    if change.accepted:
        return None
    change.call.require(
        bool(change.reason.strip()),
        expected=f"a reason why {change.words} is rejected",
        observed="an empty reason",
        help='Give SetParametersResult a reason, for example "kp_pitch is 40.0; it has to be above 51.0".',
    )
    return "rejected"


@obligation(6, of=record.changes, see="10_parameters_and_balance#push-why")
def accepts_the_table(change: Change) -> str | None:
    """All values within the table's limits are accepted"""
    if change.faults or any(value > gains.HIGHEST[name] for name, value in change.values.items()):
        return None
    change.call.require(
        change.accepted,
        expected=f"{change.words} accepted, as it is within the limits of the task's table",
        observed=f"rejected, {f'with the reason “{change.reason}”' if change.reason else 'without a reason'}",
        help=advice.about_refusing(change),
    )
    return "one" if len(change.values) == 1 else "several together"


@obligation(9, 10, of=readings)
def has_what_it_accepted(reading: Reading) -> str | None:
    """The parameters have the accepted values, and none from a rejected set"""
    if not reading.before:
        return None
    last, found = reading.before[-1], reading.gains
    wrong = _wrong(found, last.after)
    reading.call.require(
        not wrong,
        expected=f"the parameters {gains.in_words(last.after, wrong)}, as last accepted",
        observed=gains.in_words(found, wrong),
        help="Do not set or store values in the on-set callback: the set may still be rejected. rclpy sets the "
        "parameters after you accept.",
    )
    how = "accepted" if last.accepted else "rejected"
    return f"{how}, {'one' if len(last.values) == 1 else 'several together'}"


# -- published messages -----------------------------------------------------------------------------------------------


@obligation(7, of=record.batches)
def publishes_them_in_time(batch: Batch) -> str | None:
    """Within 1 s after each accepted set, all five current gains are published on balance_gains"""
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
        observed=f"it came {right[0] - answered:.1f} s later" if right else "no message",
        help=help,
        at=answered,
        see=see,
    )
    return "nothing new" if last.after == old else "new gains"


@obligation(8, of=record.batches, see="10_parameters_and_balance#atomic-why")
def one_message_each(batch: Batch) -> str | None:
    """Each accepted set has exactly one message, with the gains right after it"""
    accepted, messages = batch.accepted, batch.messages
    if not accepted:
        return None
    if len(messages) >= len(accepted):  # otherwise messages would be compared with the wrong sets
        for change, message in zip(accepted, messages, strict=False):
            _require_gains(message, change.after, old=change.before, after=f"{change.words} was accepted")
    expect(
        len(messages) == len(accepted),
        expected=f"one message on {TOPIC} for each of these sets: {'; '.join(change.words for change in accepted)}",
        observed=f"{len(messages)} message(s) in total",
        help=advice.about_number(len(messages), accepted),
        at=messages[-1].t if messages else accepted[-1].call.answered.t,
    )
    several = "several at once" if len(batch.changes) > 1 else "one"
    return f"{several}, one rejected" if len(accepted) < len(batch.changes) else several


@obligation(9, of=record.batches, see="10_parameters_and_balance#book-why")
def publishes_nothing_for_rejected_sets(batch: Batch) -> str | None:
    """Nothing is published for a rejected set"""
    if batch.accepted:
        return None
    if batch.messages:
        event = batch.messages[0]
        raise Failure(
            expected=f"no message on {TOPIC}, because {batch.changes[0].words} was rejected",
            observed=f"a message with {gains.in_words(_gains_in(event))}",
            help="Only accept or reject in the on-set callback; publish in the post-set callback.",
            at=event.t,
        )
    return "rejected" if len(batch.changes[0].values) == 1 else "rejected together"


@obligation(9, of=whole_run)
def publishes_only_what_was_accepted(run: Transcript) -> str | None:
    """Every published gain had been accepted before, or was the value at the start"""
    first, heard = record.gains_at_first(run), run.received(TOPIC)
    accepted = [change for change in record.changes(run) if change.accepted]
    for event in heard:
        sent = [change.after for change in accepted if change.call.sent.t <= event.t]
        wrongs = [_wrong(_gains_in(event), each) for each in (first, *sent)]
        wrong = [name for name in gains.NAMES if all(name in each for each in wrongs)]
        expect(
            not wrong,
            expected=f"only accepted gains on {TOPIC}",
            observed=f"{gains.in_words(_gains_in(event), wrong)}, which was never accepted",
            help=advice.KEEP_NO_COPY,
            at=event.t,
        )
    return "all messages" if heard else None


def _listeners(run: Transcript) -> list[tuple[Transcript, str, float]]:
    """Occasions: each robot that starts late, with its name and when (s) it subscribed."""
    names = [step[1] for step in run.params.get("steps", ()) if step[0] == "listen"]
    return [(run, name, run.mark(name)) for name in names]


@obligation(11, of=_listeners, see="01_robot_and_graph#late-why")
def keeps_the_last(occasion: tuple[Transcript, str, float]) -> str:
    """A robot that subscribes later receives the last message, because the topic is latched"""
    run, name, began = occasion
    heard = run.received(name)
    require_alive(run)
    expect(
        bool(heard),
        expected=f"a node that subscribes later to receive the last message of {TOPIC}",
        observed="it received no message",
        help="Give the publisher QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL) instead of 10.",
        at=began,
    )
    _require_gains(
        heard[0], record.gains_at(run, heard[0].t), old=gains.DEFAULTS, after="these are the current gains"
    )
    return "after sets" if changes_before(run, began) else "at first"


@obligation(12, of=whole_run)
def publishes_its_start_once(run: Transcript) -> str | None:
    """At the start it publishes its gains once, with the values with which it was started"""
    if not run.params.get("latched"):
        return None  # of messages published before the subscription, only a latched one arrives
    first_set = min((change.call.sent.t for change in record.changes(run)), default=math.inf)
    heard = [event for event in run.received(TOPIC) if event.t < first_set]
    expect(
        len(heard) == 1,
        expected=f"1 message on {TOPIC} at the start",
        observed=f"{len(heard)} messages",
        help="Publish once at the end of the constructor, not from a timer. Register the post-set callback after the "
        "declarations, as each declaration calls it, too.",
        at=heard[-1].t if heard else run.end,
    )
    _require_gains(heard[0], record.gains_at_first(run), old=gains.DEFAULTS, after="these are its parameters")
    return "started with values" if run.params.get("started_with") else "defaults"


# -- the node and the robot -------------------------------------------------------------------------------------------


@obligation(13, of=whole_run, see="10_parameters_and_balance#late-why")
def refuses_to_start(run: Transcript) -> str:
    """Started with an invalid value, the program exits with status 1 and a line on stderr"""
    require_within_limits(run)
    name, value = run.params["name"], run.params["value"]
    if run.first(ev.NodeExited) is None:
        raise Failure(
            expected=f"the program exits with status 1 when it is started with {name}:={value}",
            observed=f"it still runs; the last line on stderr: {run.last_words or 'none'}",
            help="The program prints something about the invalid value, but goes on: return 1 from main() instead."
            if name in run.output("stderr")
            else "Register the on-set callback before you declare the parameters: declaring them sets the values from "
            "the command line.",
            at=run.end,
        )
    require_failure(run, EXIT_TIMEOUT, f"it was started with {name}:={value}")
    return f"{name}:={value}"


@obligation(14, of=whole_run)
def survives(run: Transcript) -> str | None:
    """With the published gains the robot survives a push of 10 N·s"""
    pushed = run.last_command("push").t
    if not gains.hold_the_robot(record.gains_at(run, pushed)):
        return None
    watched = run.robot_between(pushed, pushed + FALL_TIME)
    fallen = next((robot.t for robot in run.ground_truth if robot.mode == RobotMode.FALLEN), None)
    off = [event.t for event in run.all(ev.MotorPowerReceived) if not event.on]
    off += [robot.t for robot in watched if not robot.motors_enabled]
    at = pushed if fallen is None else fallen
    heard = [event for event in run.received(TOPIC) if event.t <= at]
    how = "its motors were switched off" if fallen is None else f"the robot fell at {fallen:.1f} s"
    expect(
        fallen is None and not off,
        expected="the robot to stay on its feet with its motors on, as gains that cannot hold it are rejected",
        observed=f"{how}; it was pushed at {pushed:.1f} s; the last message on {TOPIC} before that: "
        + (gains.in_words(_gains_in(heard[-1])) if heard else "none"),
        help="A message on motor_power switched the motors off: publish only on balance_gains."
        if off
        else "Compare these gains with the task's table. In the on-set callback, reject values outside its limits.",
        at=at,
    )
    return "other gains" if changes_before(run, pushed) else "defaults"


# -- messages ---------------------------------------------------------------------------------------------------------


def _gains_in(event: ev.MessageReceived) -> dict[str, float]:
    return {name: getattr(event.message, name) for name in gains.NAMES}


def _wrong(found: gains.Gains, wanted: gains.Gains) -> list[str]:
    """Return the names of the gains that differ by more than rounding."""
    return [
        name
        for name in gains.NAMES
        if not math.isclose(found[name], wanted[name], rel_tol=1e-6, abs_tol=1e-6)
    ]


def _require_gains(event: ev.MessageReceived, wanted: gains.Gains, *, old: gains.Gains, after: str) -> None:
    """Require that a message has the gains `wanted`, because of `after`; `old` are the gains before the set."""
    found = _gains_in(event)
    if wrong := _wrong(found, wanted):
        raise Failure(
            expected=f"{TOPIC} with {gains.in_words(wanted, wrong)}, because {after}",
            observed=gains.in_words(found, wrong),
            help=advice.about_values(found, wanted, old, wrong),
            at=event.t,
        )
