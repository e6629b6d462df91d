"""What the server says in its feedback, beside what hand and cup did."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

from autograder.authoring import SUCCEEDED, Goal, end_of_feedback, ev, expect, require_good_feedback_rate
from autograder.authoring.evidence.robot_record import between
from autograder.authoring.walking.life import accepted, ended_at, interrupted, was_not_awaited
from humanoid_interfaces.action import PickAndPlace
from ros_runtime.message_constants import GoalStatus, name_of

from .life import canceled_at, commanded, is_for_the_cup, robbed_at
from .truth import Grip, as_tuple, grips, taken_from

MIN_DURATION = 3.0  # s; a goal of less tells little about its feedback
AGE = 0.7  # s that what feedback tells may be old
AHEAD = 0.3  # s that a stage may be named before it begins
PLACE_SLACK = 0.04  # m
FORCE_SLACK = 2.0  # N
ROUNDING = 0.01  # percent
MIN_LAST_PERCENT = 50.0  # percent, that are done at the last feedback at least
FELT = 1.0  # N
ABOVE = 0.03  # m

_FEEDBACK = PickAndPlace.Feedback
STAGES = (
    *(_FEEDBACK.APPROACHING, _FEEDBACK.GRASPING, _FEEDBACK.LIFTING),
    *(_FEEDBACK.MOVING, _FEEDBACK.PLACING, _FEEDBACK.RETREATING),
)


def feedback_at_5_hz(goal: Goal) -> str | None:
    """Feedback comes at 5 Hz without a gap over 1 s."""
    if not _is_worth_telling(goal):
        return None
    require_good_feedback_rate(goal)
    return _how_it_ended(goal)


def names_stages_in_order(goal: Goal) -> str | None:
    """The stage goes through approaching, grasping, lifting, moving, placing, retreating."""
    if not accepted(goal) or not goal.feedback:
        return None
    named = [event.feedback.stage for event in goal.feedback]
    unknown = next((stage for stage in named if stage not in STAGES), None)
    expect(
        unknown is None,
        expected=f"feedback.stage to be one of {', '.join(STAGES)}",
        observed=f"{unknown!r}",
        help="Use the constants of PickAndPlace.Feedback: they are written in small letters.",
    )
    if goal.status != SUCCEEDED:
        return _how_it_ended(goal)
    order = [named[0], *(after for before, after in pairwise(named) if after != before)]
    expect(
        order == list(STAGES),
        expected=f"the stages {', '.join(STAGES)}, in this order",
        observed=", ".join(order),
        help="Set the stage when the stage begins, each once, and publish feedback all the time: also while you wait "
        "for the hand, the fingers or an answer.",
        at=goal.feedback[0].t,
    )
    return _how_it_ended(goal)


def stages_are_true_at(goal: Goal) -> str | None:
    """Each stage is named while it lasts."""
    if not _is_worth_telling(goal):
        return None
    height = taken_from(goal)[2]
    signs: dict[str, tuple[str, Callable[[Grip], bool]]] = {
        _FEEDBACK.APPROACHING: ("nothing between the fingers", lambda grip: grip.force < FELT),
        _FEEDBACK.LIFTING: ("the cup between the fingers", lambda grip: grip.force >= FELT),
        _FEEDBACK.MOVING: ("the cup off the table", lambda grip: grip.cup[2] > height + ABOVE),
        _FEEDBACK.RETREATING: ("nothing between the fingers any more", lambda grip: grip.force < FELT),
    }
    whole, cut = _seen_by(goal), min(canceled_at(goal) or math.inf, robbed_at(goal) or math.inf)
    for event in goal.feedback:
        stage = event.feedback.stage
        if stage not in signs or event.t > cut:
            continue
        what, is_so = signs[stage]
        seen = between(whole, event.t - AGE, event.t + AHEAD)
        expect(
            any(map(is_so, seen)),
            expected=f"{what} while the stage is {stage!r}",
            observed=f"{seen[-1].force:.1f} N, and a cup {seen[-1].cup[2] - height:.2f} m above where it stood",
            help="Set the stage when it begins, not when it is over.",
            at=event.t,
        )
    return _how_it_ended(goal)


def values_are_measured(goal: Goal) -> str | None:
    """hand_pose, distance_to_object and grasp_force in the feedback are measured."""
    if not _is_worth_telling(goal):
        return None
    whole = _seen_by(goal)
    for event in goal.feedback:
        seen = between(whole, event.t - AGE, event.t)
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
    return _how_it_ended(goal)


def _is_worth_telling(goal: Goal) -> bool:
    """Return whether there was a cup to tell of, and no fall or Ctrl-C ended it; then there has to be feedback."""
    if not is_for_the_cup(goal) or was_not_awaited(goal) or interrupted(goal) or commanded(goal, "push"):
        return False
    if ended_at(goal) < goal.accepted_at + MIN_DURATION:
        return False
    end_of_feedback(goal)
    return True


def _how_it_ended(goal: Goal) -> str:
    return name_of(GoalStatus, goal.status or GoalStatus.UNKNOWN)


def _seen_by(goal: Goal) -> list[Grip]:
    """Return hand and cup of the time that the feedback tells of."""
    return grips(goal.run, goal.feedback[0].t - AGE, min(goal.feedback[-1].t + AHEAD, goal.run.end))


def _require_true_hand(event: ev.FeedbackReceived, seen: Sequence[Grip]) -> None:
    said = event.feedback.hand_pose
    (x, y, z), claimed = seen[-1].hand, as_tuple(said.pose.position)
    off = min(math.dist(claimed, grip.hand) for grip in seen)
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


def percentage_never_falls(goal: Goal) -> str | None:
    """percent_complete rises from 0 towards 100 and never falls."""
    if not _is_worth_telling(goal):
        return None
    cut = canceled_at(goal) or math.inf
    said = [(event.t, float(event.feedback.percent_complete)) for event in goal.feedback if event.t < cut]
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
    if goal.status != SUCCEEDED:
        return _how_it_ended(goal)
    last_t, last = said[-1]
    expect(
        last >= MIN_LAST_PERCENT,
        expected=f"percent_complete of more than {MIN_LAST_PERCENT:.0f} while the hand retreats",
        observed=f"{last:.1f}",
        help="It is a percentage, 0 to 100, of the whole task.",
        at=last_t,
    )
    return _how_it_ended(goal)
