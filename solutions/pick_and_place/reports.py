"""Compares what the server says in its feedback with what hand and cup did."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.feedback import end_of_feedback, require_feedback
from autograder.authoring.goal import SUCCEEDED, Goal
from humanoid_interfaces.action import PickAndPlace

from .truth import Grip, around, as_tuple, grips, taken_from

AGE = 0.7  # s that what feedback tells may be old
AHEAD = 0.3  # s that a stage may be named before it begins
PLACE_SLACK = 0.04  # m
FORCE_SLACK = 2.0  # N
ROUNDING = 0.01  # percent
MUCH = 50.0  # percent, that are done at the last feedback at least
FELT = 1.0  # N
ABOVE = 0.03  # m

_FEEDBACK = PickAndPlace.Feedback
STAGES = (
    *(_FEEDBACK.APPROACHING, _FEEDBACK.GRASPING, _FEEDBACK.LIFTING),
    *(_FEEDBACK.MOVING, _FEEDBACK.PLACING, _FEEDBACK.RETREATING),
)


def require_stages_in_order(goal: Goal) -> None:
    """Require that a goal that SUCCEEDED went through all stages, in the order of the constants, each once."""
    require_feedback(goal)
    goal.require_result(SUCCEEDED)
    named = [event.feedback.stage for event in goal.feedback]
    unknown = next((stage for stage in named if stage not in STAGES), None)
    expect(
        unknown is None,
        expected=f"feedback.stage to be one of {', '.join(STAGES)}",
        observed=f"{unknown!r}",
        help="Use the constants of PickAndPlace.Feedback: they are written in small letters.",
    )
    order = [named[0], *(after for before, after in pairwise(named) if after != before)]
    expect(
        order == list(STAGES),
        expected=f"the stages {', '.join(STAGES)}, in this order",
        observed=", ".join(order),
        help="Set the stage when the stage begins, each once, and publish feedback all the time: also while you wait "
        "for the hand, the fingers or an answer.",
        at=goal.feedback[0].t,
    )


def require_true_stages(goal: Goal) -> None:
    """Require that hand and cup did what the stage says, at about that time."""
    require_feedback(goal)
    end_of_feedback(goal)
    height = taken_from(goal)[2]
    signs: dict[str, tuple[str, Callable[[Grip], bool]]] = {
        _FEEDBACK.APPROACHING: ("nothing between the fingers", lambda grip: grip.force < FELT),
        _FEEDBACK.LIFTING: ("the cup between the fingers", lambda grip: grip.force >= FELT),
        _FEEDBACK.MOVING: ("the cup off the table", lambda grip: grip.cup[2] > height + ABOVE),
        _FEEDBACK.RETREATING: ("nothing between the fingers any more", lambda grip: grip.force < FELT),
    }
    whole = _seen_by(goal)
    for event in goal.feedback:
        stage = event.feedback.stage
        if stage not in signs:
            continue
        what, is_so = signs[stage]
        seen = around(whole, event.t - AGE, event.t + AHEAD)
        expect(
            any(map(is_so, seen)),
            expected=f"{what} while the stage is {stage!r}",
            observed=f"{seen[-1].force:.1f} N, and a cup {seen[-1].cup[2] - height:.2f} m above where it stood",
            help="Set the stage when it begins, not when it is over.",
            at=event.t,
        )


def require_true_values(goal: Goal) -> None:
    """Require that hand_pose, distance_to_object and grasp_force are those measured at about that time."""
    require_feedback(goal)
    end_of_feedback(goal)
    whole = _seen_by(goal)
    for event in goal.feedback:
        seen = around(whole, event.t - AGE, event.t)
        _require_true_hand(event, seen)
        _require_between(
            event,
            "distance_to_object",
            [grip.distance for grip in seen],
            PLACE_SLACK,
            "m",
            "It is the straight distance in x, y and z from r_hand/pose to objects/<id>/pose.",
        )
        _require_between(
            event,
            "grasp_force",
            [grip.force for grip in seen],
            FORCE_SLACK,
            "N",
            "It is wrench.force.y of the last r_gripper/wrench, not what the goal asks for.",
        )


def _seen_by(goal: Goal) -> list[Grip]:
    """Return hand and cup of the time that the feedback tells of."""
    return grips(goal.run, goal.feedback[0].t - AGE, min(goal.feedback[-1].t + AHEAD, goal.run.end))


def _require_true_hand(event: ev.FeedbackReceived, seen: Sequence[Grip]) -> None:
    said = event.feedback.hand_pose
    off = min(math.dist(as_tuple(said.pose.position), grip.hand) for grip in seen)
    x, y, z = seen[-1].hand
    expect(
        said.header.frame_id == "odom" and off <= PLACE_SLACK,
        expected=f"feedback.hand_pose in frame odom near x {x:.2f}, y {y:.2f}, z {z:.2f} m",
        observed=f"frame {said.header.frame_id!r}, {off:.2f} m from there",
        help="Copy the last message of r_hand/pose, header and pose.",
        at=event.t,
    )


def _require_between(
    event: ev.FeedbackReceived, field: str, truths: Sequence[float], slack: float, unit: str, help: str
) -> None:
    claimed = getattr(event.feedback, field)
    low, high = max(0.0, min(truths) - slack), max(truths) + slack
    expect(
        low <= claimed <= high,
        expected=f"feedback.{field} between {low:.2f} and {high:.2f} {unit}",
        observed=f"{claimed:.2f} {unit}",
        help=help,
        at=event.t,
    )


def require_rising_percentage(goal: Goal) -> None:
    """Require that percent_complete stays within 0 to 100, never falls, and has come far at the end."""
    require_feedback(goal)
    goal.require_result(SUCCEEDED)
    said = [(event.t, float(event.feedback.percent_complete)) for event in goal.feedback]
    for t, percent in said:
        expect(
            0.0 <= percent <= 100.0 + ROUNDING,
            expected="feedback.percent_complete from 0 to 100",
            observed=f"{percent:.1f}",
            help="It is the share of the whole task that is done, in percent.",
            at=t,
        )
    for (_, before), (t, percent) in pairwise(said):
        expect(
            percent >= before - ROUNDING,
            expected="percent_complete that never falls",
            observed=f"{percent:.1f} after {before:.1f}",
            help="Give each stage its own share of the 100 percent: the second begins where the first one ends.",
            at=t,
        )
    last_t, last = said[-1]
    expect(
        last >= MUCH,
        expected=f"percent_complete of more than {MUCH:.0f} while the hand retreats",
        observed=f"{last:.1f}",
        help="It is a percentage, 0 to 100, of the whole task.",
        at=last_t,
    )
