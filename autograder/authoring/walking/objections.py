"""What speaks against a goal that walks the robot: what its request holds, and how robot and server are just then."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.goal import Goal
from autograder.authoring.robot_topic import DELIVERY
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.life import others, overlaps, phase, run_of
from autograder.authoring.walking.planar import stamped_target
from autograder.authoring.walking.truth import require_accepted

UNIT = 0.01  # by which the length of a quaternion that was rounded may differ from 1


@dataclass(frozen=True)
class Objection:
    """A reason to reject a goal.

    Attributes:
        because: of a goal, in words.
        help: what to do if it was accepted.
        holds: whether the reason is there; None: nobody can tell, or the statement leaves it open.
    """

    because: Callable[[Goal], str]
    help: str
    holds: Callable[[Goal], bool | None]


def accepting(*objections: Objection) -> Callable[[Goal], str | None]:
    """Make what an obligation requires: a goal that nothing speaks against is accepted."""

    def accepts_what_can_be_walked_to(goal: Goal) -> str | None:
        """It accepts a pose in frame odom when nothing speaks against it, whatever came before."""
        if any(objection.holds(goal) is not False for objection in objections):
            return None
        _require_heard(run_of(goal))
        require_accepted(goal)
        return phase(goal)

    return accepts_what_can_be_walked_to


def rejecting(name: str, objection: Objection, sentence: str) -> Callable[[Goal], str | None]:
    """Make what an obligation requires: a goal with this objection is rejected; `name` and `sentence` say so."""

    def rejects(goal: Goal) -> str | None:
        if not objection.holds(goal):
            return None
        goal.require_rejected(because=objection.because(goal), help=objection.help)
        return phase(goal)

    rejects.__name__, rejects.__doc__ = name, sentence
    return rejects


# -- what the request holds -------------------------------------------------------------------------------------------


def _frame(goal: Goal) -> str:
    return stamped_target(goal).header.frame_id


def _pose(goal: Goal) -> Sequence[float]:
    position, turned = stamped_target(goal).pose.position, stamped_target(goal).pose.orientation
    return (position.x, position.y, position.z, turned.x, turned.y, turned.z, turned.w)


def _is_no_rotation(goal: Goal) -> bool | None:
    length = math.hypot(*_pose(goal)[3:])
    if length == 0.0:
        return True
    return False if abs(length - 1.0) <= UNIT or not math.isfinite(length) else None


def _has_senseless_velocity(goal: Goal) -> bool:
    return not (math.isfinite(goal.request.max_velocity) and goal.request.max_velocity >= 0.0)


def _what_is_not_finite(goal: Goal) -> str:
    names = ("position.x", "position.y", "position.z", *(f"orientation.{axis}" for axis in "xyzw"))
    bad = [
        f"{name} is {value:g}"
        for name, value in zip(names, _pose(goal), strict=True)
        if not math.isfinite(value)
    ]
    return ", ".join(bad) or "a number is not finite"


FRAME = Objection(
    lambda goal: f"frame {_frame(goal)!r} is not 'odom'",
    "Compare request.target_pose.header.frame_id with 'odom', the one frame that you know, and return "
    "GoalResponse.REJECT for every other, instead of rejecting those that you have thought of.",
    lambda goal: _frame(goal) != "odom",
)
NOT_FINITE = Objection(
    _what_is_not_finite,
    "Test every number of position and orientation with math.isfinite() in goal_callback: NaN compares false with "
    "everything.",
    lambda goal: not all(map(math.isfinite, _pose(goal))),
)
NO_ROTATION = Objection(
    lambda goal: "x, y, z and w are all 0, which is no rotation",
    "Four zeros are no rotation, and no heading to turn to: reject it when x² + y² + z² + w² is not about 1.",
    _is_no_rotation,
)
VELOCITY = Objection(
    lambda goal: f"max_velocity is {goal.request.max_velocity:g}",
    "Accept max_velocity only if math.isfinite(v) and v >= 0.0: NaN < 0.0 is false, too.",
    _has_senseless_velocity,
)
UNSAID_VELOCITY = Objection(
    lambda goal: "", "", lambda goal: None if _has_senseless_velocity(goal) else False
)
UNSAID_ROTATION = Objection(lambda goal: "", "", lambda goal: None if _is_no_rotation(goal) else False)


# -- how robot and server are -----------------------------------------------------------------------------------------


def _last_known(goal: Goal, topic: str) -> list[Any] | None:
    """Return what may be the last message of a played robot's topic, oldest first; None if the robot is no played one.

    A message may have been on its way. The list is empty when certainly none had come.
    """
    published = run_of(goal).all(ev.MessagePublished)
    if not published:
        return None
    answered = goal.answer.t if goal.answer else goal.sent.t
    sent = [each for each in published if each.topic == topic and each.t <= answered]
    arrived = [index for index, each in enumerate(sent) if each.t <= goal.sent.t - DELIVERY]
    if sent and not arrived:
        return [None, *(each.message for each in sent)]
    return [each.message for each in sent[arrived[-1] :]] if sent else []


def _has_no_odom(goal: Goal) -> bool | None:
    known = _last_known(goal, "odom")
    if known is None:
        return False
    return True if not known else None if None in known else False


def _has_no_power(goal: Goal) -> bool | None:
    known = _last_known(goal, "robot_state")
    if known is not None:
        powered = {message.motors_enabled for message in known if message is not None}
        return None if len(powered) != 1 or None in known else not powered.pop()
    answered = goal.answer.t if goal.answer else goal.sent.t
    robots = goal.run.robot_between(goal.sent.t - DELIVERY, answered)
    states = {robot.motors_enabled for robot in robots}
    return None if len(states) != 1 else not states.pop()


NO_ODOM = Objection(
    lambda goal: "no odom has come, so nobody knows where the robot is",
    "Keep None until the first odom arrives, and reject while it is None.",
    _has_no_odom,
)
NO_POWER = Objection(
    lambda goal: "robot_state.motors_enabled is false",
    "Keep the last robot_state, and reject in goal_callback while its motors_enabled is false.",
    _has_no_power,
)


def _is_busy(goal: Goal) -> bool | None:
    active = [overlaps(other, goal) for other in others(goal)]
    return True if True in active else None if None in active else False


BUSY = Objection(
    lambda goal: "another goal is under way, and the robot has one pair of legs",
    "Remember in goal_callback that a goal was accepted, forget it when execute ends, and reject meanwhile. Callback "
    "groups do not do that: each accepted goal gets a thread of its own.",
    _is_busy,
)


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
        help="Say in goal_callback itself that the robot is taken, at the moment you accept: a flag that execute sets "
        "comes too late for the next goal."
        if taken
        else "Nothing else was under way: reject a goal only when another one was accepted before.",
        at=goal.sent.t,
    )
    return f"{len(rivals) + 1} together"


def _require_heard(run: Transcript) -> None:
    """Require that the node subscribes to what the scenario publishes in the robot's place."""
    for topic, last in {each.topic: each for each in run.all(ev.MessagePublished)}.items():
        expect(
            last.subscriptions > 0,
            expected=f"a subscription to {topic}",
            observed="the grader published it, and nobody was subscribed",
            help=f'create_subscription(…, "{topic}", …), a relative name.',
            at=last.t,
        )
