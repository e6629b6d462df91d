"""Compares what a node published on balance_gains with the sets that it said it had accepted."""

from __future__ import annotations

import math
from collections.abc import Sequence

from autograder.authoring import events as ev
from autograder.authoring.failure import Failure, expect
from autograder.authoring.readiness import require_alive
from autograder.authoring.robot_topic import DELIVERY
from autograder.authoring.transcript import Transcript

from .gains import NAMES
from .sets import TOPIC, Change, Gains, call_named, changes, gains_before, messages_after


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
            help=_about_silence(run, changes_something=new != old),
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


def _about_silence(run: Transcript, *, changes_something: bool) -> str:
    if not _has_publisher(run):
        return f"Give create_publisher the name {TOPIC!r}, letter by letter, without a slash or a ~ in front."
    if not changes_something:
        return "The value was the same as before, and the set was accepted: each accepted set has a message."
    return "Publish in the post-set callback: self.add_post_set_parameters_callback(self._apply)."


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
        expected=f"{TOPIC} with {in_words(gains, wrong)}" + (f", because {after}" if after else ""),
        observed=in_words(found, wrong),
        help=_advice(found, gains, old, wrong),
        at=event.t,
    )


def require_once(run: Transcript, name: str) -> None:
    """Require one message for each set of a request that was accepted, in order."""
    require_published(run, name)
    gains = gains_before(run, name)
    accepted = [change for change in changes(call_named(run, name)) if change.accepted]
    messages = messages_after(run, name)
    wrong_number = Failure(
        expected=f"{_messages(len(accepted))} on {TOPIC}: {_sets_in_words(accepted)}",
        observed=_messages(len(messages)),
        help=_about_the_number(len(messages), accepted),
        at=messages[-1].t,
    )
    if len(messages) < len(accepted):
        raise wrong_number  # and their values would be compared with those of other sets
    for change, message in zip(accepted, messages, strict=False):
        gains |= change.numbers
        require_gains(message, gains, after=f"{change.words} was accepted")
    if len(messages) > len(accepted):
        raise wrong_number


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
        observed=in_words({each: getattr(messages[0].message, each) for each in NAMES}, NAMES),
        help="An on-set callback only says yes or no: another one may still refuse. Publish in the post-set callback, "
        "which rclpy calls only when all is accepted and stored.",
        at=messages[0].t,
    )


def in_words(gains: Gains, names: Sequence[str]) -> str:
    """Return gains as people write them: 'kp_pitch 40, kd_roll 1'."""
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
            "Each set that is accepted has a message of its own: publish in the post-set callback each time, and from "
            "no timer."
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
