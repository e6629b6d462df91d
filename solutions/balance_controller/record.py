"""What the node was asked to set, what it answered and published, and which gains it has then."""

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
    """One set: the values that were asked for together, what the node answered, and its gains before and after."""

    call: Call
    values: Mapping[str, Any]
    accepted: bool
    reason: str
    before: Gains
    after: Gains

    @property
    def faults(self) -> dict[str, str]:
        """Why each value that has to be refused is, by its name."""
        return {name: fault for name, value in self.values.items() if (fault := fault_of(name, value))}

    @property
    def words(self) -> str:
        """The values as people write them."""
        return in_words(self.values)


@dataclass(frozen=True)
class Batch:
    """Sets that followed one another without a pause, and what was published from then on until the next ones."""

    run: Transcript
    changes: Sequence[Change]
    messages: Sequence[ev.MessageReceived]

    @property
    def accepted(self) -> list[Change]:
        """The sets that the node accepted."""
        return [change for change in self.changes if change.accepted]


@dataclass(frozen=True)
class Reading:
    """A request for the values of all parameters, and the sets that had been answered by then."""

    call: Call
    before: Sequence[Change]

    @property
    def parameters(self) -> dict[str, ParameterValue]:
        """The values as the node answered; empty ones where it does not have them."""
        values = iter(self.call.response.values)
        return {name: next(values, ParameterValue()) for name in NAMES}

    @property
    def gains(self) -> dict[str, float]:
        """The values as numbers; NaN where there is none."""
        return {name: float(_value(value)) for name, value in self.parameters.items()}


def readings(run: Transcript) -> list[Reading]:
    """Return the requests for the parameters' values, in order."""
    asked = calls(f"{SERVICES}get_parameters")(run)
    return [
        Reading(call, changes_before(run, call.sent.t) if number else ()) for number, call in enumerate(asked)
    ]


def changes(run: Transcript) -> list[Change]:
    """Return every set, in order: one for each parameter of a request, or one in all where it was atomic."""
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
    """Return the gains that the node said it had, the first time it was asked."""
    for call in calls(f"{SERVICES}get_parameters")(run)[:1]:
        return Reading(call, ()).gains
    raise unseen(run, "nobody asked for the gains")


def changes_before(run: Transcript, t: float) -> list[Change]:
    """Return the sets that were answered by a moment (s)."""
    return [change for change in changes(run) if change.call.answered.t <= t]


def gains_at(run: Transcript, t: float) -> Gains:
    """Return the gains that the node should have at a moment (s), after all that it accepted."""
    before = changes_before(run, t)
    return before[-1].after if before else gains_at_first(run)


def batches(run: Transcript) -> list[Batch]:
    """Return the sets in batches, each of which ends where nothing is set for longer than a message may take."""
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
            call.run, "Refuse by returning SetParametersResult(successful=False, reason=…); raise nothing."
        )
    answer = call.response
    if hasattr(answer, "result"):
        return [(asked, answer.result)]
    call.require(
        len(answer.results) == len(asked),
        expected=f"{len(asked)} results, one for each parameter",
        observed=f"{len(answer.results)}",
        help="Leave set_parameters to rclpy: it calls your callbacks and answers.",
    )
    return [
        ({name: value}, result) for (name, value), result in zip(asked.items(), answer.results, strict=True)
    ]


def _value(value: ParameterValue) -> Any:
    return getattr(value, _FIELDS[value.type]) if value.type in _FIELDS else math.nan
