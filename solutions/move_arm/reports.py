"""Compares the feedback and the result of a goal with what the arm did."""

from __future__ import annotations

import math
import re

from autograder.authoring import (
    ABORTED,
    SUCCEEDED,
    Goal,
    end_of_feedback,
    error_name,
    ev,
    expect,
    require_good_feedback_rate,
)
from autograder.authoring.walking.life import ended_at, interrupted, was_not_awaited
from autograder.authoring.walking.reports import require_error_code

from .endings import GOAL_TOLERANCE
from .life import ends_by_itself, hold_of, is_carried_out, silent_since, situation
from .objections import RANGES
from .plan import Plan, errors, largest
from .truth import joints_at, joints_between, plan_of

MAX_AGE = 0.7  # s, by which values in the feedback may be late or early
STRIDE = 4  # only every fourth of the simulator's 50 reports a second is used
ERROR_SLACK = 0.1  # rad
PROGRESS_SLACK = 15.0  # percent
ROUNDING = 0.01  # percent
MIN_DURATION = 1.5  # s; the feedback of a shorter goal is not checked
ALIKE = 0.1  # rad; if two errors differ by less, either joint may be named
_CODES_ABOUT_A_JOINT = ("PATH_TOLERANCE_VIOLATED", "GOAL_TOLERANCE_VIOLATED")
_NAME_THE_WORST = "Name the one joint with the largest error: max(errors, key=errors.get)."


def feedback_at_10_hz(goal: Goal) -> str | None:
    """Feedback is published at 10 Hz, without a gap of more than 1 s."""
    if not _has_time_for_feedback(goal):
        return None
    require_good_feedback_rate(goal, wanted=10.0, lowest=6.0, highest=15.0)
    return situation(goal)


def feedback_is_true(goal: Goal) -> str | None:
    """waypoint, max_error and progress_percentage in the feedback match the arm's motion."""
    if not _has_time_for_feedback(goal):
        return None
    end = min(end_of_feedback(goal), silent_since(goal) or math.inf)
    plan, progress = plan_of(goal), 0.0
    for event in goal.feedback:
        if event.t > end:
            break
        _require_true_point(plan, event)
        _require_true_error(goal, plan, event)
        progress = _require_true_progress(plan, event, progress)
    return situation(goal)


def names_no_error(goal: Goal) -> str | None:
    """The result of a goal that SUCCEEDED has error_code NONE and an empty error_msg."""
    if goal.status != SUCCEEDED:
        return None
    require_error_code(goal, "NONE", because="the arm has arrived")
    goal.expect(
        "error_msg", "", because="nothing went wrong", help="Fill error_msg only when the goal is aborted."
    )
    return situation(goal)


def names_the_joint(goal: Goal) -> str | None:
    """error_msg names the joint with the largest error, and no other."""
    if goal.status != ABORTED or not is_carried_out(goal) or (hold := hold_of(goal)) is None:
        return None
    assert goal.result
    said, at = goal.result.result.error_msg, goal.result.t
    off = errors(joints_at(goal.run, at).positions, plan_of(goal).at(at))
    worst, error = largest(off)
    if error_name(goal) not in _CODES_ABOUT_A_JOINT or error < GOAL_TOLERANCE:
        return None
    named = [joint for joint in RANGES if re.search(rf"(?<!\w){joint}(?!\w)", said)]
    right = [joint for joint in named if off.get(joint, 0.0) >= error - ALIKE]
    expect(
        bool(right),
        expected=f"error_msg with the name of the joint that is farthest off its trajectory, {worst}",
        observed=f"{said!r}",
        help=_NAME_THE_WORST
        if named
        else "Put the joint's name, as in joint_states, into result.error_msg before abort().",
        at=at,
    )
    others = [joint for joint in named if joint != right[0]]
    expect(
        not others,
        expected=f"error_msg that names {right[0]} alone",
        observed=f"it also names {', '.join(others)}: {said!r}",
        help=_NAME_THE_WORST,
        at=at,
    )
    return f"{len(hold.joints)} blocked"


def _has_time_for_feedback(goal: Goal) -> bool:
    """Return whether an accepted goal lasted long enough for its feedback to be checked."""
    if not is_carried_out(goal) or was_not_awaited(goal) or interrupted(goal):
        return False
    return ends_by_itself(goal) or ended_at(goal) >= goal.accepted_at + MIN_DURATION


def _require_true_point(plan: Plan, event: ev.FeedbackReceived) -> None:
    earliest, latest = plan.point_at(event.t - MAX_AGE), plan.point_at(event.t + MAX_AGE)
    expect(
        earliest <= event.feedback.waypoint <= latest,
        expected=f"feedback.waypoint {latest}, the point to which the arm moves {_since(plan, event):.1f} s after "
        "acceptance",
        observed=f"{event.feedback.waypoint}",
        help="feedback.waypoint is the index, from 0, of the first point whose time_from_start is not over yet; after "
        "that of the last point, it stays the index of the last point.",
        at=event.t,
    )


def _require_true_error(goal: Goal, plan: Plan, event: ev.FeedbackReceived) -> None:
    claimed = event.feedback.max_error
    expect(
        math.isfinite(claimed) and claimed >= 0.0,
        expected="feedback.max_error of 0 rad or more",
        observed=f"{claimed}",
        help="For each joint of the goal compute abs(position in joint_states - position on the trajectory now), and "
        "take the maximum.",
        at=event.t,
    )
    seen = joints_between(goal.run, max(plan.begin, event.t - MAX_AGE), event.t)
    at_the_ends = plan.at(event.t - MAX_AGE), plan.at(event.t)
    truths = [
        largest(errors(report.positions, wanted))[1]
        for report in (*seen[::STRIDE], seen[-1])
        for wanted in (*at_the_ends, plan.at(report.t))
    ]
    low, high = max(0.0, min(truths) - ERROR_SLACK), max(truths) + ERROR_SLACK
    expect(
        low <= claimed <= high,
        expected=f"feedback.max_error between {low:.2f} and {high:.2f} rad, as measured in the simulator",
        observed=f"{claimed:.2f} rad",
        help="Set feedback.max_error in every round: in a new feedback message it is 0."
        if claimed == 0.0
        else "Compare joint_states with the joint's position on the trajectory at that time, interpolated between two "
        "points, not with the next or the last point.",
        at=event.t,
    )


def _require_true_progress(plan: Plan, event: ev.FeedbackReceived, before: float) -> float:
    claimed = float(event.feedback.progress_percentage)
    expect(
        0.0 <= claimed <= 100.0 + ROUNDING,
        expected="feedback.progress_percentage from 0 to 100",
        observed=f"{claimed:.1f}",
        help="Compute 100 times the share of the trajectory's duration that is over, at most 100.",
        at=event.t,
    )
    expect(
        claimed >= before - ROUNDING,
        expected="feedback.progress_percentage never to fall",
        observed=f"{claimed:.1f} after {before:.1f}",
        help="Use the share of the trajectory's duration that is over: it only increases.",
        at=event.t,
    )
    share = 100.0 * min(1.0, _since(plan, event) / plan.times[-1])
    slack = PROGRESS_SLACK + 100.0 * MAX_AGE / plan.times[-1]
    expect(
        abs(claimed - share) <= slack,
        expected=f"feedback.progress_percentage about {share:.0f}, {_since(plan, event):.1f} s after acceptance",
        observed=f"{claimed:.1f}",
        help="Compute 100 times the share of the trajectory's duration that is over: a percentage from 0 to 100.",
        at=event.t,
    )
    return claimed


def _since(plan: Plan, event: ev.FeedbackReceived) -> float:
    """Return the time (s) since acceptance; at least 0, as feedback may arrive before the acceptance."""
    return max(0.0, event.t - plan.begin)
