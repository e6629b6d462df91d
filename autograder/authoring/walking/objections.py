"""Objections, the reasons to reject a goal that walks the robot: a wrong request, or the state of robot or server."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite
from typing import Any

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.goal import Goal
from autograder.authoring.evidence.robot_topic import DELIVERY
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import expect
from autograder.authoring.obligation import Obligation, goals, obligation
from autograder.authoring.walking.life import others, overlaps, phase, run_of
from autograder.authoring.walking.planar import numbers_of, stamped_target, target
from autograder.authoring.walking.truth import require_accepted

UNIT_SLACK = 0.01  # by which the length of a rounded quaternion may differ from 1


@dataclass(frozen=True)
class Objection:
    """A reason to reject a goal.

    Attributes:
        because: returns the reason for a goal, in words; "": it does not apply; None: unknown, or left open by the
            statement.
        help: what to do if it was accepted.
    """

    because: Callable[[Goal], str | None]
    help: str = ""


def objection(help: str) -> Callable[[Callable[[Goal], str | None]], Objection]:
    """Make an objection of the decorated function: the docstring of `frames` is the sentence of `rejects_frames`."""
    return lambda because: Objection(because, help)


def accepting(*objections: Objection) -> Callable[[Goal], str | None]:
    """Return the requirement, for an obligation, that a goal without objections is accepted."""

    def accepts_what_can_be_walked_to(goal: Goal) -> str | None:
        """It accepts a pose in frame odom that it has no reason to reject, whatever came before."""
        if any(objection.because(goal) != "" for objection in objections):
            return None
        _require_subscriptions(run_of(goal))
        require_accepted(goal)
        return phase(goal)

    return accepts_what_can_be_walked_to


def rejects(clause: int, objection: Objection, *, sentence: str = "", see: str = "") -> Obligation:
    """Make the obligation that a goal with this objection is rejected; `sentence` replaces its default sentence."""

    def require(goal: Goal) -> str | None:
        because = objection.because(goal)
        if not because:
            return None
        goal.require_rejected(because=because, help=objection.help)
        return phase(goal)

    require.__name__ = f"rejects_{objection.because.__name__.lstrip('_')}"
    require.__doc__ = sentence or objection.because.__doc__
    return obligation(clause, of=goals, see=see)(require)


# -- what the request holds -------------------------------------------------------------------------------------------


@objection(
    "Compare request.target_pose.header.frame_id with 'odom', the one frame that you know, and return "
    "GoalResponse.REJECT for every other, instead of rejecting those that you have thought of."
)
def frames(goal: Goal) -> str:
    """It rejects a pose in any other frame than odom."""
    frame = stamped_target(goal).header.frame_id
    return "" if frame == "odom" else f"frame {frame!r} is not 'odom'"


@objection(
    "Test every number of position and orientation with math.isfinite() in goal_callback: every `<` and `>` with "
    "NaN is false."
)
def nan(goal: Goal) -> str:
    """It rejects a pose that holds NaN or infinity."""
    bad = {name: number for name, number in numbers_of(target(goal)).items() if not isfinite(number)}
    return ", ".join(f"{name} is {number:g}" for name, number in bad.items())


@objection(
    "Four zeros are no rotation, and no heading to turn to: reject it when x² + y² + z² + w² is not about 1."
)
def no_rotation(goal: Goal) -> str | None:
    """It rejects an orientation of four zeros."""
    turned = target(goal).orientation
    length = math.hypot(turned.x, turned.y, turned.z, turned.w)
    if length == 0.0:
        return "x, y, z and w are all 0, which is no rotation"
    return "" if abs(length - 1.0) <= UNIT_SLACK or not isfinite(length) else None


@objection("Accept max_velocity only if math.isfinite(v) and v >= 0.0: NaN < 0.0 is false, too.")
def velocities(goal: Goal) -> str:
    """It rejects a max_velocity that is negative, NaN or infinite."""
    velocity = goal.request.max_velocity
    return "" if isfinite(velocity) and velocity >= 0.0 else f"max_velocity is {velocity:g}"


UNSAID_VELOCITY = Objection(lambda goal: None if velocities.because(goal) else "")
UNSAID_ROTATION = Objection(lambda goal: None if no_rotation.because(goal) else "")


# -- the state of robot and server ------------------------------------------------------------------------------------


def _last_known(goal: Goal, topic: str) -> list[Any] | None:
    """Return what the node may have received last on a topic of a scripted robot, oldest first.

    The list begins with None if perhaps no message had arrived, and is empty if certainly none had. Without a scripted
    robot the result is None.
    """
    published = run_of(goal).all(ev.MessagePublished)
    if not published:
        return None
    sent = [each for each in published if each.topic == topic and each.t <= _answered(goal)]
    arrived = [index for index, each in enumerate(sent) if each.t <= goal.sent.t - DELIVERY]
    if sent and not arrived:
        return [None, *(each.message for each in sent)]
    return [each.message for each in sent[arrived[-1] :]] if sent else []


def _answered(goal: Goal) -> float:
    return goal.answer.t if goal.answer else goal.sent.t


@objection("Keep None until the first odom arrives, and reject while it is None.")
def before_odom(goal: Goal) -> str | None:
    """It rejects goals before the first odom, and accepts them after it."""
    known = _last_known(goal, "odom")
    if known == []:
        return "no odom has arrived, so the robot's pose is unknown"
    return None if known and None in known else ""


@objection("Keep the last robot_state, and reject in goal_callback while its motors_enabled is false.")
def without_power(goal: Goal) -> str | None:
    """It rejects a goal while the motors are off."""
    known = _last_known(goal, "robot_state")
    robots = goal.run.robot_between(goal.sent.t - DELIVERY, _answered(goal)) if known is None else known
    powered = {robot and robot.motors_enabled for robot in robots}
    if powered == {False}:
        return "robot_state.motors_enabled is false"
    return "" if powered == {True} else None


@objection(
    "Remember in goal_callback that a goal was accepted, forget it when execute ends, and reject meanwhile. Callback "
    "groups do not do that: each accepted goal gets a thread of its own."
)
def while_busy(goal: Goal) -> str | None:
    """It rejects a goal while another runs."""
    active = [overlaps(other, goal) for other in others(goal)]
    if True in active:
        return "another goal is active, and the robot has only one pair of legs"
    return None if None in active else ""


def one_of_several(goal: Goal) -> str | None:
    """Of goals that come in the same moment exactly one is accepted."""
    rivals = [
        other
        for other in others(goal)
        if goal.answer and other.answer and goal.sent.t <= other.sent.t <= goal.answer.t
    ]
    if not rivals or any(overlaps(other, goal) is not False for other in others(goal) if other not in rivals):
        return None
    taken = sum(bool(each.answer and each.answer.accepted) for each in (goal, *rivals))
    expect(
        taken == 1,
        expected="one of the goals that came together to be accepted, and the others rejected",
        observed=f"{taken} of {len(rivals) + 1} were accepted",
        help="Set the flag that the robot is busy in goal_callback, when you accept: a flag that execute sets is too "
        "late for the next goal."
        if taken
        else "No other goal was active: reject a goal only when another one was accepted before.",
        at=goal.sent.t,
    )
    return f"{len(rivals) + 1} together"


def _require_subscriptions(run: Transcript) -> None:
    """Require that the node subscribes to the topics that the scenario publishes in place of the robot."""
    for topic, last in {each.topic: each for each in run.all(ev.MessagePublished)}.items():
        expect(
            last.subscriptions > 0,
            expected=f"a subscription to {topic}",
            observed="the grader published it, but no subscription matched",
            help=f'create_subscription(…, "{topic}", …), a relative name.',
            at=last.t,
        )
