"""Advice for failures: gains that are published wrongly, and a set that is wrongly accepted or rejected."""

from __future__ import annotations

import math
from collections.abc import Sequence

from autograder.authoring import Transcript, ev
from autograder.authoring.diagnosis.connections import OUTSIDE

from .gains import INTEGER, LIMIT, NAMES, NEGATIVE, NOT_FINITE, TOO_WEAK, Gains
from .record import TOPIC, Change

# For each fault of a value: why it has to be rejected, in words, and the advice.
REJECTIONS = {
    TOO_WEAK: (
        "to hold the trunk against gravity, kp must be above 51 N·m/rad",
        "In the on-set callback, reject a kp that is not above 51.0: the new values are in its argument.",
    ),
    NEGATIVE: ("it is negative", "Let the range begin at 0.0, or check the value in the on-set callback."),
    NOT_FINITE: ("it is not finite", "Every `<` and `>` with NaN is false: use math.isfinite()."),
    INTEGER: (
        "it is an integer",
        "Do not set dynamic_typing in the descriptor: then a parameter declared with a float accepts only doubles.",
    ),
    LIMIT: (
        "kp has to be above 51, and max_torque above 0",
        "A floating_point_range includes both of its ends: reject the limit itself in the on-set callback.",
    ),
}
KEEP_NO_COPY = (
    "Read all five parameters in the post-set callback, so that no value of a rejected set is published."
)
_TWINS = {"kp_pitch": "kp_roll", "kp_roll": "kp_pitch", "kd_pitch": "kd_roll", "kd_roll": "kd_pitch"}


def about_accepting(change: Change, fault: str) -> str:
    """Return advice on a set that was accepted although one of its values has this fault."""
    if len(change.values) > 1 and next(iter(change.values)) not in change.faults:
        return "Check every parameter in the list that the on-set callback receives, not only the first one."
    return REJECTIONS[fault][1]


def about_refusing(change: Change) -> str:
    """Return advice on a set that was rejected although it is valid."""
    if "out of range" in change.reason:
        return "Use the limits from the task's table in floating_point_range."
    if change.reason:
        return "Check the new values in the callback's argument: there self.get_parameter() still has the old values."
    return "Return SetParametersResult(successful=True) from the on-set callback if all values are valid."


def about_silence(run: Transcript, *, is_late: bool, changes_something: bool) -> tuple[str, str]:
    """Return advice on a set whose message is missing or late, and the lesson ('': that of the check)."""
    if is_late:
        return "Publish in the callback itself, not from a timer.", ""
    if run.one(ev.Mark, "name", "nobody publishes"):
        return (
            f"There is no publisher of {TOPIC}: give create_publisher this name, without a slash or ~.",
            OUTSIDE,
        )
    if not changes_something:
        return "Publish a message after every accepted set, also if it changes no value.", ""
    return "Publish in the post-set callback: self.add_post_set_parameters_callback(self._apply).", ""


def about_values(found: Gains, wanted: Gains, old: Gains, wrong: Sequence[str]) -> str:
    """Return advice on a message with wrong gains; `old` are the gains before the set."""
    before = {name for name in NAMES if math.isclose(found[name], old[name], rel_tol=1e-6)}
    if set(wrong) <= before != set(NAMES):
        return (
            f"The message has old values of some gains: read {' and '.join(wrong)} from the parameters, too."
        )
    if set(wrong) <= before:
        return "These are the values from before the set: read the parameters and publish in the post-set callback."
    if all(name in _TWINS and found[name] == wanted[_TWINS[name]] for name in wrong):
        return "pitch and roll are swapped: set each field of the message to the parameter of the same name."
    if all(found[name] == 0.0 for name in wrong):
        return f"In a new message every field is 0: set {' and '.join(wrong)}, too."
    if all(math.isclose(found[name], wanted[name], rel_tol=0.01, abs_tol=0.5) for name in wrong):
        return "Publish each gain exactly as it was set, without rounding."
    return KEEP_NO_COPY


def about_number(observed: int, accepted: Sequence[Change]) -> str:
    """Return advice on a wrong number of messages; each accepted set must have exactly one."""
    if observed < len(accepted):
        return "Publish in each call of the post-set callback, not from a timer: every accepted set has a message."
    if len(accepted) == 1 and observed == len(accepted[0].values):
        return "Publish once in each call of the post-set callback, after the loop over the parameters, not in it."
    return "Publish only in the post-set callback, neither in the on-set callback nor from a timer."
