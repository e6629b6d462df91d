"""Compares what the server says of an arm, in feedback and results, with what the arm did."""

from __future__ import annotations

import math
import re

from autograder.authoring import events as ev
from autograder.authoring.arms.endings import ErrorCode
from autograder.authoring.arms.plan import Plan, errors, largest
from autograder.authoring.arms.truth import joints_between, plan_of
from autograder.authoring.failure import Failure, expect
from autograder.authoring.feedback import end_of_feedback, require_feedback
from autograder.authoring.goal import ABORTED, SUCCEEDED, Goal
from autograder.authoring.walking.reports import require_error_code
from ros_runtime.message_constants import name_of

AGE = 0.7  # s that what feedback tells may be old, or early
ERROR_SLACK = 0.1  # rad
PROGRESS_SLACK = 15.0  # percent
ROUNDING = 0.01  # percent
_NAME_THE_WORST = "Name the one joint with the largest error: max(errors, key=errors.get)."


def require_true_feedback(goal: Goal) -> None:
    """Require that waypoint, max_error and progress are those of the arm at about that time."""
    require_feedback(goal)
    end = end_of_feedback(goal)  # until then it has to be true
    plan = plan_of(goal)
    progress = 0.0
    for event in goal.feedback:
        if event.t > end:
            break
        _require_true_point(plan, event)
        _require_true_error(goal, plan, event)
        progress = _require_true_progress(plan, event, progress)


def _require_true_point(plan: Plan, event: ev.FeedbackReceived) -> None:
    earliest, latest = plan.point_at(event.t - AGE), plan.point_at(event.t + AGE)
    expect(
        earliest <= event.feedback.waypoint <= latest,
        expected=f"feedback.waypoint {latest}, the point that the arm moves to {_since(plan, event):.1f} s after the "
        "acceptance",
        observed=f"{event.feedback.waypoint}",
        help="Count from 0: it is the index of the first point whose time_from_start is still to come, and of the "
        "last one after that.",
        at=event.t,
    )


def _require_true_error(goal: Goal, plan: Plan, event: ev.FeedbackReceived) -> None:
    claimed = event.feedback.max_error
    expect(
        math.isfinite(claimed) and claimed >= 0.0,
        expected="feedback.max_error of 0 rad or more",
        observed=f"{claimed}",
        help="It is the largest abs(measured - where the trajectory has the joint now) over the goal's joints.",
        at=event.t,
    )
    seen = joints_between(goal.run, max(plan.begin, event.t - AGE), event.t)
    at_the_ends = plan.at(event.t - AGE), plan.at(event.t)
    truths = [
        largest(errors(report.positions, wanted))[1]
        for report in seen
        for wanted in (*at_the_ends, plan.at(report.t))
    ]
    low, high = max(0.0, min(truths) - ERROR_SLACK), max(truths) + ERROR_SLACK
    expect(
        low <= claimed <= high,
        expected=f"feedback.max_error between {low:.2f} and {high:.2f} rad, as the arm was off its trajectory",
        observed=f"{claimed:.2f} rad",
        help="Fill feedback.max_error in every round: it never left 0."
        if claimed == 0.0
        else "Compare joint_states with where the trajectory has the joint at that moment, between two points: not "
        "with the next point, nor with the last.",
        at=event.t,
    )


def _require_true_progress(plan: Plan, event: ev.FeedbackReceived, before: float) -> float:
    claimed = float(event.feedback.progress_percentage)
    expect(
        0.0 <= claimed <= 100.0 + ROUNDING,
        expected="feedback.progress_percentage from 0 to 100",
        observed=f"{claimed:.1f}",
        help="100 times the share of the time that is over, at most 100.",
        at=event.t,
    )
    expect(
        claimed >= before - ROUNDING,
        expected="progress that never falls",
        observed=f"{claimed:.1f} after {before:.1f}",
        help="Take the share of the time that is over: that only grows.",
        at=event.t,
    )
    share = 100.0 * min(1.0, _since(plan, event) / plan.times[-1])
    slack = PROGRESS_SLACK + 100.0 * AGE / plan.times[-1]
    expect(
        abs(claimed - share) <= slack,
        expected=f"progress of about {share:.0f} percent {_since(plan, event):.1f} s after the acceptance",
        observed=f"{claimed:.1f}",
        help="It is a percentage, 0 to 100: 100 times the share of the time that is over.",
        at=event.t,
    )
    return claimed


def _since(plan: Plan, event: ev.FeedbackReceived) -> float:
    """Return how long (s) the goal had been accepted; feedback may overtake the answer."""
    return max(0.0, event.t - plan.begin)


def require_filled_result(goal: Goal) -> None:
    """Require that a goal that succeeded says NONE, and no reason."""
    goal.require_accepted().require_result(SUCCEEDED)
    require_error_code(goal, "NONE", because="the arm has arrived")
    goal.expect(
        "error_msg", "", because="nothing went wrong", help="Fill error_msg only when the goal is aborted."
    )


def require_aborted(
    goal: Goal, code: str, *, because: str, help: str, other_code: str = ""
) -> ev.ResultReceived:
    """Require that a goal was ABORTED with an error_code, and return the result.

    Args:
        goal: which was accepted.
        code: the name of the constant.
        because: why it had to end so.
        help: what to do if the goal went on, or succeeded.
        other_code: what to do if it ended for another reason; '' where that says nothing.
    """
    goal.require_accepted()
    result = goal.require_result(ABORTED, help=help)
    given = result.result.error_code
    if other_code and given not in (ErrorCode.NONE, ErrorCode[code]):
        raise Failure(
            expected=f"error_code {code}, because {because}",
            observed=f"error_code {name_of(ErrorCode, given)}",
            help=other_code,
            at=result.t,
        )
    require_error_code(goal, code, because=because)
    return result


def require_named(goal: Goal, joint: str, others: list[str]) -> None:
    """Require that the result's error_msg names a joint that was held, and none of the others."""
    goal.run.told("hold_joint", joint=joint)
    result = goal.require_result(ABORTED)
    said = result.result.error_msg
    named = [each for each in others if _names(said, each)]
    expect(
        _names(said, joint),
        expected=f"error_msg with the name of the joint that is off its trajectory most, {joint}",
        observed=f"{said!r}",
        help=_NAME_THE_WORST
        if named
        else "Put the joint's name, as in joint_states, into result.error_msg before abort().",
        at=result.t,
    )
    expect(
        not named,
        expected=f"error_msg that names {joint} alone",
        observed=f"it also names {', '.join(named)}: {said!r}",
        help=_NAME_THE_WORST,
        at=result.t,
    )


def _names(text: str, joint: str) -> bool:
    return re.search(rf"(?<!\w){re.escape(joint)}(?!\w)", text) is not None
