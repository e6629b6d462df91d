"""What the node was asked to set, what it answered, and which gains it has then."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.msg import ParameterType, ParameterValue

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.failure import Failure, expect
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript

from .gains import DEFAULTS, NAMES

TOPIC = "balance_gains"
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


def _value(value: ParameterValue) -> Any:
    field = _VALUES.get(value.type)
    return getattr(value, field) if field else None
