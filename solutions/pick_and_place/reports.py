"""Compares the server's feedback with what hand and cup did."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

from autograder.authoring import SUCCEEDED, Goal, end_of_feedback, ev, expect, require_good_feedback_rate
from autograder.authoring.evidence.robot_record import between
from autograder.authoring.walking.life import accepted, ended_at, interrupted, was_not_awaited
from humanoid_interfaces.action import PickAndPlace
from ros_runtime.message_constants import GoalStatus, name_of

from .life import canceled_at, commanded, ends_by_itself, is_for_the_cup, is_possible, robbed_at
from .truth import Grip, as_tuple, grips, taken_from

MIN_DURATION = 3.0  # s; the feedback of a shorter goal is not checked
MAX_AGE = 0.7  # s, of a measurement in the feedback
MAX_LEAD = 0.3  # s, by which feedback may name a stage before it begins
PLACE_SLACK = 0.04  # m
FORCE_SLACK = 2.0  # N
ROUNDING = 0.01  # percent
MIN_LAST_PERCENT = 50.0  # percent, in the last feedback of a goal that SUCCEEDED
TOUCH_FORCE = 1.0  # N
OFF_THE_TABLE = 0.03  # m

_FEEDBACK = PickAndPlace.Feedback
STAGES = (
    *(_FEEDBACK.APPROACHING, _FEEDBACK.GRASPING, _FEEDBACK.LIFTING),
    *(_FEEDBACK.MOVING, _FEEDBACK.PLACING, _FEEDBACK.RETREATING),
)


def feedback_at_5_hz(goal: Goal) -> str | None:
    """Feedback is published at 5 Hz, without a gap of more than 1 s."""
    if not _must_have_feedback(goal):
        return None
    require_good_feedback_rate(goal)
    return _how_it_ended(goal)


def names_stages_in_order(goal: Goal) -> str | None:
    """feedback.stage is approaching, grasping, lifting, moving, placing and retreating, in this order."""
    if not accepted(goal) or not goal.feedback:
        return None
    named = [event.feedback.stage for event in goal.feedback]
    unknown = next((stage for stage in named if stage not in STAGES), None)
    expect(
        unknown is None,
        expected=f"feedback.stage to be one of {', '.join(STAGES)}",
        observed=f"{unknown!r}",
        help="Use the constants of PickAndPlace.Feedback, e.g. PickAndPlace.Feedback.APPROACHING: their values are in "
        "lower case.",
    )
    if goal.status != SUCCEEDED and not (ends_by_itself(goal) and is_possible(goal)):
        return _how_it_ended(goal)
    order = [named[0], *(after for before, after in pairwise(named) if after != before)]
    expect(
        order == list(STAGES),
        expected=f"the stages {', '.join(STAGES)}, in this order",
        observed=", ".join(order),
        help="Set feedback.stage once, when the stage begins. Publish feedback all the time, also while you wait for "
        "the hand, the fingers or a response.",
        at=goal.feedback[0].t,
    )
    return _how_it_ended(goal)


def stages_are_true_at(goal: Goal) -> str | None:
    """feedback.stage names a stage while it lasts."""
    if not _must_have_feedback(goal):
        return None
    height = taken_from(goal)[2]
    signs: dict[str, tuple[str, Callable[[Grip], bool]]] = {
        _FEEDBACK.APPROACHING: ("nothing between the fingers", lambda grip: grip.force < TOUCH_FORCE),
        _FEEDBACK.LIFTING: ("the cup between the fingers", lambda grip: grip.force >= TOUCH_FORCE),
        _FEEDBACK.MOVING: ("the cup off the table", lambda grip: grip.cup[2] > height + OFF_THE_TABLE),
        _FEEDBACK.RETREATING: ("nothing between the fingers any more", lambda grip: grip.force < TOUCH_FORCE),
    }
    whole, cut = _seen_by(goal), min(canceled_at(goal) or math.inf, robbed_at(goal) or math.inf)
    for event in goal.feedback:
        stage = event.feedback.stage
        if stage not in signs or event.t > cut:
            continue
        what, is_so = signs[stage]
        seen = between(whole, event.t - MAX_AGE, event.t + MAX_LEAD)
        expect(
            any(map(is_so, seen)),
            expected=f"{what} while feedback.stage is {stage!r}",
            observed=f"a force of {seen[-1].force:.1f} N, and the cup {seen[-1].cup[2] - height:.2f} m above where it "
            "stood",
            help="Set feedback.stage when the stage begins, not when it is over.",
            at=event.t,
        )
    return _how_it_ended(goal)


def values_are_measured(goal: Goal) -> str | None:
    """hand_pose, distance_to_object and grasp_force in the feedback are measured."""
    if not _must_have_feedback(goal):
        return None
    whole = _seen_by(goal)
    for event in goal.feedback:
        seen = between(whole, event.t - MAX_AGE, event.t)
        _require_true_hand(event, seen)
        _require_between(
            event,
            "distance_to_object",
            [grip.distance for grip in seen],
            PLACE_SLACK,
            "m",
            "Compute the distance in x, y and z between r_hand/pose and objects/<id>/pose.",
        )
        _require_between(
            event,
            "grasp_force",
            [grip.force for grip in seen],
            FORCE_SLACK,
            "N",
            "Copy wrench.force.y of the last message on r_gripper/wrench, not the goal's grasp_force.",
        )
    return _how_it_ended(goal)


def _must_have_feedback(goal: Goal) -> bool:
    """Return whether the goal was for the cup and lasted, without a fall or Ctrl-C; if so, require feedback."""
    if not is_for_the_cup(goal) or was_not_awaited(goal) or interrupted(goal) or commanded(goal, "push"):
        return False
    if ended_at(goal) < goal.accepted_at + MIN_DURATION:
        return False
    end_of_feedback(goal)
    return True


def _how_it_ended(goal: Goal) -> str:
    return name_of(GoalStatus, goal.status or GoalStatus.UNKNOWN)


def _seen_by(goal: Goal) -> list[Grip]:
    """Return hand and cup for the whole time that the feedback describes."""
    return grips(goal.run, goal.feedback[0].t - MAX_AGE, min(goal.feedback[-1].t + MAX_LEAD, goal.run.end))


def _require_true_hand(event: ev.FeedbackReceived, seen: Sequence[Grip]) -> None:
    said = event.feedback.hand_pose
    (x, y, z), claimed = seen[-1].hand, as_tuple(said.pose.position)
    off = min(math.dist(claimed, grip.hand) for grip in seen)
    expect(
        said.header.frame_id == "odom" and off <= PLACE_SLACK,
        expected=f"feedback.hand_pose in frame odom near x {x:.2f}, y {y:.2f}, z {z:.2f} m",
        observed=f"frame {said.header.frame_id!r}, {off:.2f} m from there",
        help="Copy header and pose of the last message on r_hand/pose.",
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


def percentage_never_falls(goal: Goal) -> str | None:
    """percent_complete rises from 0 towards 100 and never falls."""
    if not _must_have_feedback(goal):
        return None
    cut = canceled_at(goal) or math.inf
    said = [(event.t, float(event.feedback.percent_complete)) for event in goal.feedback if event.t < cut]
    for t, percent in said:
        expect(
            0.0 <= percent <= 100.0 + ROUNDING,
            expected="feedback.percent_complete from 0 to 100",
            observed=f"{percent:.1f}",
            help="Set percent_complete to the share of the whole task that is done, in percent.",
            at=t,
        )
    for (_, before), (t, percent) in pairwise(said):
        expect(
            percent >= before - ROUNDING,
            expected="feedback.percent_complete never to fall",
            observed=f"{percent:.1f} after {before:.1f}",
            help="Give each stage its own range of the 100 percent, which begins where the previous range ends.",
            at=t,
        )
    if goal.status != SUCCEEDED:
        return _how_it_ended(goal)
    last_t, last = said[-1]
    expect(
        last >= MIN_LAST_PERCENT,
        expected=f"percent_complete of at least {MIN_LAST_PERCENT:.0f} in the last feedback",
        observed=f"{last:.1f}",
        help="percent_complete is a percentage of the whole task, from 0 to 100, not a share from 0 to 1.",
        at=last_t,
    )
    return _how_it_ended(goal)
