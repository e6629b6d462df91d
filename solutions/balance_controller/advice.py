"""What to do about gains that are published wrongly, or a set that should have been refused or accepted."""

from __future__ import annotations

import math
from collections.abc import Sequence

from autograder.authoring import Transcript, ev
from autograder.authoring.diagnosis.connections import OUTSIDE

from .gains import INTEGER, LIMIT, NAMES, NEGATIVE, NOT_FINITE, TOO_WEAK, Gains
from .record import TOPIC, Change

# By the reason why a value is refused: that reason in words, and what to do.
REFUSALS = {
    TOO_WEAK: (
        "gravity topples the trunk with 51 N·m/rad",
        "Refuse a kp that is not above 51.0 in the on-set callback: the new values are in its argument.",
    ),
    NEGATIVE: ("it is negative", "Let the range begin at 0.0, or look at the value in the on-set callback."),
    NOT_FINITE: ("it is not finite", "Every `<` and `>` with NaN is false: ask math.isfinite()."),
    INTEGER: (
        "it is an integer",
        "Leave dynamic_typing alone: a parameter declared with a float stays a double.",
    ),
    LIMIT: (
        "kp has to be above 51, and max_torque above 0",
        "A floating_point_range includes both of its ends: refuse the limit itself in the on-set callback.",
    ),
}
KEEP_NO_COPY = "Read all five parameters in the post-set callback: a refused set must leave nothing behind."
_TWINS = {"kp_pitch": "kp_roll", "kp_roll": "kp_pitch", "kd_pitch": "kd_roll", "kd_roll": "kd_pitch"}


def about_accepting(change: Change, fault: str) -> str:
    """Return what to do when a set was accepted although one of its values has this fault."""
    if len(change.values) > 1 and next(iter(change.values)) not in change.faults:
        return "Look at every parameter in the list that the on-set callback gets, not only at the first one."
    return REFUSALS[fault][1]


def about_refusing(change: Change) -> str:
    """Return what to do about a set that was refused, though nothing is wrong with it."""
    if "out of range" in change.reason:
        return "Take the limits of the range from the table of the task."
    if change.reason:
        return "Look at the new values, the callback's argument: self.get_parameter() still has the old ones there."
    return "Return SetParametersResult(successful=True) from the on-set callback where nothing is wrong."


def about_silence(run: Transcript, *, is_late: bool, changes_something: bool) -> tuple[str, str]:
    """Return what to do about a set whose message is missing or late, and the lesson ('': the check's)."""
    if is_late:
        return "Publish in the callback itself, not from a timer.", ""
    if run.one(ev.Mark, "name", "nobody publishes"):
        return (
            f"Nobody publishes {TOPIC} there: give create_publisher this name, without slash or ~.",
            OUTSIDE,
        )
    if not changes_something:
        return "Nothing changed, but the set was accepted: each accepted set has a message.", ""
    return "Publish in the post-set callback: self.add_post_set_parameters_callback(self._apply).", ""


def about_values(found: Gains, wanted: Gains, old: Gains, wrong: Sequence[str]) -> str:
    """Return what to do about a message that has other gains than it should; `old` are those of before the set."""
    before = {name for name in NAMES if math.isclose(found[name], old[name], rel_tol=1e-6)}
    if set(wrong) <= before != set(NAMES):
        return f"Other gains are new in this message: read {' and '.join(wrong)} from the parameters, too."
    if set(wrong) <= before:
        return (
            "These are the values of before the set: publish in the post-set callback, and read them there."
        )
    if all(name in _TWINS and found[name] == wanted[_TWINS[name]] for name in wrong):
        return "pitch and roll are exchanged: give each field of the message the parameter of its name."
    if all(found[name] == 0.0 for name in wrong):
        return f"A new message holds zeros: set {' and '.join(wrong)}, too."
    if all(math.isclose(found[name], wanted[name], rel_tol=0.01, abs_tol=0.5) for name in wrong):
        return "Publish each gain as it was set, without rounding."
    return KEEP_NO_COPY


def about_number(observed: int, accepted: Sequence[Change]) -> str:
    """Return what to do about so many messages, where each of the accepted sets has one."""
    if observed < len(accepted):
        return "Each accepted set has a message: publish in the post-set callback each time, from no timer."
    if len(accepted) == 1 and observed == len(accepted[0].values):
        return "Publish once in each call of the post-set callback, behind the loop over the parameters, not in it."
    return "Publish in the post-set callback and nowhere else: not in the on-set callback, and from no timer."
