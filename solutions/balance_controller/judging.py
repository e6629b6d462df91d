"""Compares what a node published on balance_gains with the sets that it said it had accepted."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.msg import ParameterType, ParameterValue

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.client_checks import require_failure
from autograder.authoring.failure import Failure, expect
from autograder.authoring.missing import unseen
from autograder.authoring.readiness import require_alive, require_within_limits
from autograder.authoring.robot_topic import DELIVERY
from autograder.authoring.transcript import Transcript
from ros_runtime.message_constants import RobotMode

from .gains import DEFAULTS, NAMES

TOPIC = "balance_gains"
GIVING_UP = 12.0  # s for a program to refuse what it is started with
AFTERMATH = 3.0  # s after a push in which a robot falls if it does
NEAR_DEFAULT = 1.0  # the robot's own gains are not whole numbers

Gains = Mapping[str, float]
_VALUES = {
    ParameterType.PARAMETER_BOOL: "bool_value",
    ParameterType.PARAMETER_INTEGER: "integer_value",
    ParameterType.PARAMETER_DOUBLE: "double_value",
    ParameterType.PARAMETER_STRING: "string_value",
}
_TYPES = {
    ParameterType.PARAMETER_NOT_SET: "none: it is not declared, or without a default",
    ParameterType.PARAMETER_BOOL: "a bool",
    ParameterType.PARAMETER_INTEGER: "an integer",
    ParameterType.PARAMETER_STRING: "a string",
}


@dataclass(frozen=True)
class Change:
    """One set: the values that were asked for together, and what the node answered."""

    call: Call
    values: Mapping[str, Any]
    accepted: bool
    reason: str

    @property
    def words(self) -> str:
        """The values as people write them: 'kp_pitch 40.0, kd_roll -1.0'."""
        return ", ".join(f"{name} {value!r}" for name, value in self.values.items())

    @property
    def numbers(self) -> dict[str, float]:
        """The values that are numbers, as all that is accepted should be."""
        return {name: float(value) for name, value in self.values.items() if isinstance(value, int | float)}


# -- what was asked and what was answered -----------------------------------------------------------------------------


def changes(call: Call) -> list[Change]:
    """Return the sets of a request: one for each parameter, or one in all where it was atomic."""
    asked = {parameter.name: _value(parameter.value) for parameter in call.request.parameters}
    answer = call.response
    if hasattr(answer, "result"):
        return [Change(call, asked, answer.result.successful, answer.result.reason)]
    if len(answer.results) != len(asked):
        raise Failure(
            expected=f"{len(asked)} results, one for each parameter",
            observed=f"{len(answer.results)}",
            help="Leave set_parameters to rclpy: it calls your callbacks and answers.",
            at=call.answered.t,
        )
    return [
        Change(call, {name: value}, result.successful, result.reason)
        for (name, value), result in zip(asked.items(), answer.results, strict=True)
    ]


def call_named(run: Transcript, name: str) -> Call:
    """Return a request of the scenario, which must have been answered."""
    call = run.call(name)
    _ = call.answered
    return call


def parameters_at(run: Transcript, name: str) -> dict[str, ParameterValue]:
    """Return what the node answered to a request for its parameters; none where it does not have them all."""
    values = iter(call_named(run, name).response.values)
    return {each: next(values, ParameterValue()) for each in NAMES}


def require_doubles(run: Transcript, name: str) -> dict[str, float]:
    """Return the gains that the node says it has; every one must be a double."""
    at = call_named(run, name).answered.t
    found = {}
    for each, value in parameters_at(run, name).items():
        expect(
            value.type == ParameterType.PARAMETER_DOUBLE,
            expected=f"a parameter {each} of type double",
            observed=_TYPES.get(value.type, "another type"),
            help=f"Declare it with a float as its default: self.declare_parameter({each!r}, {DEFAULTS[each]}, …).",
            at=at,
        )
        found[each] = value.double_value
    return found


def gains_before(run: Transcript, name: str) -> dict[str, float]:
    """Return the gains at a request: those of the start, and each set since then that the node accepted."""
    gains = require_doubles(run, "at the start")
    for call in _sets(run):
        if call.name == name:
            return gains
        for change in changes(call):
            if change.accepted:
                gains |= change.numbers
    raise unseen(run, f"there was no request “{name}”")


def _sets(run: Transcript) -> list[Call]:
    return [call for call in run.calls if call.service.rsplit("/", 1)[-1].startswith("set_")]


def messages_after(run: Transcript, name: str) -> list[ev.MessageReceived]:
    """Return what was published from a request on until the next one."""
    begin = call_named(run, name).sent.t
    later = [call.sent.t for call in run.calls if call.sent.t > begin]
    end = min(later, default=run.end)
    return [event for event in run.heard(TOPIC) if begin <= event.t < end]


# -- accepted sets ----------------------------------------------------------------------------------------------------


def require_accepted(run: Transcript, name: str) -> list[Change]:
    """Return the sets of a request, every one of which must have been accepted."""
    found = changes(call_named(run, name))
    for change in found:
        expect(
            change.accepted,
            expected=f"{change.words} is accepted: it is within the ranges",
            observed=f"refused: {change.reason or 'without a reason'}",
            help="Take the limits of the range from the table of the task."
            if "out of range" in change.reason
            else "Look at the new values, which are the callback's argument: self.get_parameter() still has the old "
            "ones there."
            if change.reason
            else "Return SetParametersResult(successful=True) from the on-set callback where nothing is wrong.",
            at=change.call.answered.t,
        )
    return found


def require_published(run: Transcript, name: str) -> None:
    """Require that the last message after a request has all the gains as they are then."""
    old = gains_before(run, name)
    accepted = [change for change in changes(call_named(run, name)) if change.accepted]
    new = dict(old)
    for change in accepted:
        new |= change.numbers
    what = "; ".join(change.words for change in accepted)
    messages = messages_after(run, name)
    at = call_named(run, name).answered.t
    if not messages:
        require_alive(run)
        late = [event for event in run.heard(TOPIC) if event.t > at and not _wrong(event, new)]
        expect(
            not late,
            expected=f"a message on {TOPIC} within 1 s, because {what} was accepted",
            observed=f"it came {late[0].t - at:.1f} s later" if late else "",
            help="Publish in the callback itself, not from a timer.",
            at=at,
        )
        raise Failure(
            expected=f"a message on {TOPIC} within 1 s, because {what} was accepted",
            observed="none"
            if _has_publisher(run)
            else f"none: there is no publisher of {TOPIC} in the node's namespace",
            help="Publish in the post-set callback: self.add_post_set_parameters_callback(self._apply)."
            if _has_publisher(run)
            else f"Give create_publisher the name {TOPIC!r}, letter by letter, without a slash or a ~ in front.",
            at=at,
        )
    require_gains(messages[-1], new, old=old, after=f"{what} was accepted")
    first = next(event for event in messages if not _wrong(event, new))
    expect(
        first.t <= at + DELIVERY,
        expected="the message within 1 s of the set",
        observed=f"it came {first.t - at:.1f} s later",
        help="Publish in the callback itself, not from a timer.",
        at=first.t,
    )


def _wrong(event: ev.MessageReceived, gains: Gains) -> list[str]:
    return [
        name
        for name in NAMES
        if not math.isclose(getattr(event.message, name), gains[name], rel_tol=1e-6, abs_tol=1e-6)
    ]


def _has_publisher(run: Transcript) -> bool:
    return not any(mark.name == "nobody publishes" for mark in run.all(ev.Mark))


def require_gains(
    event: ev.MessageReceived, gains: Gains, *, old: Gains | None = None, after: str = ""
) -> None:
    """Require that a message holds these gains; `old` are those of before the set, `after` what had happened."""
    found = {name: getattr(event.message, name) for name in NAMES}
    wrong = _wrong(event, gains)
    if not wrong:
        return
    raise Failure(
        expected=f"{TOPIC} with {_gains(gains, wrong)}" + (f", because {after}" if after else ""),
        observed=_gains(found, wrong),
        help=_advice(found, gains, old, wrong),
        at=event.t,
    )


def require_once(run: Transcript, name: str) -> None:
    """Require one message for each set of a request that was accepted, in order."""
    require_published(run, name)
    gains = gains_before(run, name)
    accepted = [change for change in changes(call_named(run, name)) if change.accepted]
    messages = messages_after(run, name)
    for change, message in zip(accepted, messages, strict=False):
        gains |= change.numbers
        require_gains(message, gains, after=f"{change.words} was accepted")
    expect(
        len(messages) == len(accepted),
        expected=f"{_messages(len(accepted))} on {TOPIC}: {_sets_in_words(accepted)}",
        observed=_messages(len(messages)),
        help=_about_the_number(len(messages), accepted),
        at=messages[-1].t,
    )


def require_silence(run: Transcript, name: str) -> None:
    """Require that nothing is published after a request of which everything was refused."""
    for change in changes(call_named(run, name)):
        expect(
            not change.accepted,
            expected=f"{change.words} is refused",
            observed="accepted",
            help="Refuse it first: return SetParametersResult(successful=False, reason=…) from the on-set callback.",
            at=change.call.answered.t,
        )
    messages = messages_after(run, name)
    if not messages:
        return
    raise Failure(
        expected=f"nothing on {TOPIC}, because the set was refused",
        observed=_gains({each: getattr(messages[0].message, each) for each in NAMES}, NAMES),
        help="An on-set callback only says yes or no: another one may still refuse. Publish in the post-set callback, "
        "which rclpy calls only when all is accepted and stored.",
        at=messages[0].t,
    )


# -- refused sets -----------------------------------------------------------------------------------------------------


def require_refused(run: Transcript, name: str, because: str, help: str) -> None:
    """Require that every set of a request was refused, with a reason."""
    require_alive(run, "Refuse by returning SetParametersResult(successful=False, reason=…); raise nothing.")
    for change in changes(call_named(run, name)):
        at = change.call.answered.t
        expect(
            not change.accepted,
            expected=f"{change.words} is refused: {because}",
            observed="accepted",
            help=help,
            at=at,
        )
        expect(
            bool(change.reason.strip()),
            expected=f"a reason why {change.words} is refused",
            observed="an empty reason",
            help='Give SetParametersResult a reason, too: "kp_pitch is 40.0; it has to be above 51.0".',
            at=at,
        )


def require_bad_start_refused(run: Transcript) -> None:
    """Require that the program ended with status 1 and a line on stderr, not with a traceback."""
    require_within_limits(run)
    started = f"{run.params['name']}:={run.params['value']}"
    if run.first(ev.NodeExited) is None:
        raise Failure(
            expected=f"a program that ends with status 1 when it is started with {started}",
            observed=f"it still runs; the last line on stderr: {run.last_words}"
            if run.last_words
            else "it still runs",
            help="It knows of the bad value and goes on. Return 1 from main() instead, for nobody may notice that "
            "other gains are in use than those that were asked for."
            if run.params["name"] in run.output("stderr")
            else "Declaring sets the values from the start: refuse it in the on-set callback, and register that before "
            "you declare.",
            at=run.end,
        )
    require_failure(run, GIVING_UP, (1,), f"it was started with {started}")


# -- the robot --------------------------------------------------------------------------------------------------------


def require_standing_after_push(run: Transcript) -> None:
    """Require that the robot is on its feet some seconds after the push that the simulator carried out."""
    fallen = [robot for robot in run.ground_truth if robot.mode == RobotMode.FALLEN]
    pushes = [event for event in run.all(ev.RobotCommanded) if event.command.get("do") == "push"]
    if fallen and (not pushes or fallen[0].t < pushes[0].t):
        raise _fell(run, fallen[0].t, "before anybody pushed it")
    pushed = run.told("push").t
    watched = run.robot_between(pushed, pushed + AFTERMATH)
    if fallen:
        raise _fell(run, fallen[0].t, f"{fallen[0].t - pushed:.1f} s after the push")
    expect(
        all(robot.motors_enabled for robot in watched),
        expected="motors that stay on",
        observed="they were switched off",
        help="Publish nothing but balance_gains.",
        at=pushed,
    )


def _fell(run: Transcript, at: float, when: str) -> Failure:
    heard = [event for event in run.heard(TOPIC) if event.t <= at]
    last = (
        _gains({each: getattr(heard[-1].message, each) for each in NAMES}, NAMES)
        if heard
        else "nothing at all"
    )
    off = [event for event in run.all(ev.MotorPowerReceived) if not event.on and event.t <= at]
    return Failure(
        expected="a robot that stays on its feet, because every gain that would let it fall is refused",
        observed=f"it fell {when}, at {at:.1f} s; the last on {TOPIC} before: {last}",
        help="Somebody switched its motors off: publish nothing but balance_gains."
        if off
        else "Compare these gains with the table of the task, and refuse in the on-set callback what is not in it.",
        at=at,
    )


# -- words ------------------------------------------------------------------------------------------------------------


def _value(value: ParameterValue) -> Any:
    field = _VALUES.get(value.type)
    return getattr(value, field) if field else None


def _gains(gains: Gains, names: Sequence[str]) -> str:
    return ", ".join(f"{name} {gains[name]:g}" for name in names)


def _messages(number: int) -> str:
    return "1 message" if number == 1 else f"{number} messages"


def _sets_in_words(accepted: Sequence[Change]) -> str:
    if len(accepted) == 1:
        together = " together" if len(accepted[0].values) > 1 else ""
        return f"{accepted[0].words} was set{together}"
    return "; then ".join(change.words for change in accepted) + " was set"


def _about_the_number(observed: int, accepted: Sequence[Change]) -> str:
    if observed < len(accepted):
        return (
            "Each set that is accepted has a message of its own: publish in the post-set callback each time."
        )
    if len(accepted) == 1 and observed == len(accepted[0].values):
        return "Publish once in each call of the post-set callback, behind the loop over the parameters, not in it."
    return "Publish in the post-set callback and nowhere else: not in the on-set callback, and from no timer."


def _advice(found: Gains, gains: Gains, old: Gains | None, wrong: Sequence[str]) -> str:
    before = [name for name in NAMES if old and math.isclose(found[name], old[name], rel_tol=1e-6)]
    if set(wrong) <= set(before) != set(NAMES):
        return f"Other gains are new in this message: read {' and '.join(wrong)} from the parameters, too."
    if set(wrong) <= set(before):
        return (
            "These are the values of before the set. An on-set callback is called before they change: publish in the "
            "post-set callback, and read the parameters there."
        )
    twins = {"kp_pitch": "kp_roll", "kp_roll": "kp_pitch", "kd_pitch": "kd_roll", "kd_roll": "kd_pitch"}
    if all(name in twins and math.isclose(found[name], gains[twins[name]], rel_tol=1e-6) for name in wrong):
        return "pitch and roll are exchanged: give each field of the message the parameter of its name."
    if all(found[name] == 0.0 for name in wrong):
        return f"A new message holds zeros: set {' and '.join(wrong)}, too."
    return (
        "Read all five parameters in the post-set callback, and keep no copy in the on-set callback: a set that is "
        "refused must leave nothing behind."
    )
