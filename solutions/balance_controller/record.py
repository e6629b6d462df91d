"""The requests to set parameters, the node's responses and messages, and the gains that it should then have."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from rcl_interfaces.msg import ParameterType, ParameterValue

from autograder.authoring import Call, Transcript, calls, ev, require_alive, unseen

from .gains import NAMES, Gains, fault_of, in_words

TOPIC = "balance_gains"
SERVICES = "balance_controller/"  # in front of the names of the node's parameter services
PUBLISH_TIME = 1.5  # s from an accepted set to its message; the task says 1 s
_FIELDS = {
    ParameterType.PARAMETER_INTEGER: "integer_value",
    ParameterType.PARAMETER_DOUBLE: "double_value",
}


@dataclass(frozen=True)
class Change:
    """One set: the values in the request, the node's response, and its gains before and after."""

    call: Call
    values: Mapping[str, Any]
    accepted: bool
    reason: str
    before: Gains
    after: Gains

    @property
    def faults(self) -> dict[str, str]:
        """The fault of each value that has to be rejected, by the gain's name."""
        return {name: fault for name, value in self.values.items() if (fault := fault_of(name, value))}

    @property
    def words(self) -> str:
        """The values in words."""
        return in_words(self.values)


@dataclass(frozen=True)
class Batch:
    """Sets without a pause between them, and the messages from then on until the next batch."""

    run: Transcript
    changes: Sequence[Change]
    messages: Sequence[ev.MessageReceived]

    @property
    def accepted(self) -> list[Change]:
        """The sets that the node accepted."""
        return [change for change in self.changes if change.accepted]


@dataclass(frozen=True)
class Reading:
    """A request for the values of all parameters, and the sets before it."""

    call: Call
    before: Sequence[Change]

    @property
    def parameters(self) -> dict[str, ParameterValue]:
        """The values in the response; empty ones for parameters that the node does not have."""
        values = iter(self.call.response.values)
        return {name: next(values, ParameterValue()) for name in NAMES}

    @property
    def gains(self) -> dict[str, float]:
        """The values as numbers; NaN for missing ones."""
        return {name: float(_value(value)) for name, value in self.parameters.items()}


def readings(run: Transcript) -> list[Reading]:
    """Return the requests for the parameters' values, in order."""
    asked = calls(f"{SERVICES}get_parameters")(run)
    return [
        Reading(call, changes_before(run, call.sent.t) if number else ()) for number, call in enumerate(asked)
    ]


def changes(run: Transcript) -> list[Change]:
    """Return every set, in order: one for each parameter of a request, or one for a whole atomic request."""
    asked = [call for name in ("", "_atomically") for call in calls(f"{SERVICES}set_parameters{name}")(run)]
    gains, found = gains_at_first(run), []
    for call in sorted(asked, key=lambda call: call.sent.t):
        for values, result in _sets(call):
            before = gains
            if result.successful:
                gains = {**before, **{name: float(value) for name, value in values.items()}}
            found.append(Change(call, values, result.successful, result.reason, before, gains))
    return found


def gains_at_first(run: Transcript) -> Gains:
    """Return the gains in the node's first response to get_parameters."""
    for call in calls(f"{SERVICES}get_parameters")(run)[:1]:
        return Reading(call, ()).gains
    raise unseen(run, "the gains were never read")


def changes_before(run: Transcript, t: float) -> list[Change]:
    """Return the sets whose responses came by a time (s)."""
    return [change for change in changes(run) if change.call.answered.t <= t]


def gains_at(run: Transcript, t: float) -> Gains:
    """Return the gains that the node should have at a time (s), after all accepted sets."""
    before = changes_before(run, t)
    return before[-1].after if before else gains_at_first(run)


def batches(run: Transcript) -> list[Batch]:
    """Return the sets in batches, separated by pauses longer than a message may take."""
    together: list[list[Change]] = []
    for change in changes(run):
        if not together or change.call.sent.t > together[-1][-1].call.answered.t + PUBLISH_TIME:
            together.append([])
        together[-1].append(change)
    begins = [*(batch[0].call.sent.t for batch in together), math.inf]
    return [
        Batch(run, batch, [event for event in run.received(TOPIC) if begin <= event.t < end])
        for batch, (begin, end) in zip(together, pairwise(begins), strict=True)
    ]


def _sets(call: Call) -> list[tuple[dict[str, Any], Any]]:
    """Return the values of each set of a request, and its result."""
    asked = {each.name: _value(each.value) for each in call.request.parameters}
    if call.answer is None and any(fault_of(*item) for item in asked.items()):
        require_alive(
            call.run,
            "To reject, return SetParametersResult(successful=False, reason=…); do not raise an exception.",
        )
    answer = call.response
    if hasattr(answer, "result"):
        return [(asked, answer.result)]
    call.require(
        len(answer.results) == len(asked),
        expected=f"{len(asked)} results, one for each parameter",
        observed=f"{len(answer.results)}",
        help="Do not replace rclpy's set_parameters service: it calls your callbacks and sends the response.",
    )
    return [
        ({name: value}, result) for (name, value), result in zip(asked.items(), answer.results, strict=True)
    ]


def _value(value: ParameterValue) -> Any:
    return getattr(value, _FIELDS[value.type]) if value.type in _FIELDS else math.nan
