"""What a server reports about a goal in feedback and result."""

from __future__ import annotations

from builtin_interfaces.msg import Duration

from autograder.authoring.diagnosis.goal_diagnosis import why_rclpy_aborted
from autograder.authoring.evidence.goal import ABORTED, SUCCEEDED, Goal
from autograder.authoring.failure import expect
from autograder.authoring.requirements.feedback import require_good_feedback_rate
from autograder.authoring.walking import life, reports
from ros_runtime.message_constants import GoalStatus, name_of

MIN_DURATION = 3.0  # s; a shorter goal has too little feedback to judge its rate
MIN_FEEDBACK = 8  # feedback messages
LISTENING_TIME = (
    1.2  # s for which the scenario must go on after a result, to record feedback that must not come
)
DELIVERY_SLACK = 0.3  # s by which the result may overtake feedback
FAR_DISTANCE, MIN_ESTIMATE = 0.5, 1.0  # m, s; the robot needs at least this time for this distance


def feedback_at_5_hz(goal: Goal) -> str | None:
    """Feedback comes at 5 Hz without a gap over 1 s."""
    if not life.accepted(goal) or life.was_not_awaited(goal) or life.interrupted(goal):
        return None
    if goal.accepted_at + MIN_DURATION > life.ended_at(goal):
        return None
    require_good_feedback_rate(goal)
    return "all the way"


def feedback_is_true(goal: Goal) -> str | None:
    """Pose, distance and steps in the feedback are the robot's, for this goal."""
    if not life.accepted(goal) or not goal.feedback:
        return None
    reports.require_true_feedback(goal)
    return "the first goal" if goal.run.robot_at(goal.sent.t).steps == 0 else "a later goal"


def estimates_the_time(goal: Goal) -> str | None:
    """The estimate of the time left is not negative, positive while much is left, and smaller near the end."""
    if not life.accepted(goal) or not goal.feedback:
        return None
    estimates = [seconds(each.feedback.estimated_time_remaining) for each in goal.feedback]
    is_slow = life.can_walk_at(goal, goal.request.max_velocity)
    for each, estimate in zip(goal.feedback, estimates, strict=True):
        much = is_slow and each.feedback.distance_remaining > FAR_DISTANCE
        least = MIN_ESTIMATE if much else 0.0
        expect(
            estimate >= least,
            expected=f"an estimated_time_remaining of at least {least:g} s with "
            f"{each.feedback.distance_remaining:.2f} m left",
            observed=f"{estimate:.3g} s",
            help="Divide the distance left by the velocity that you walk at: Duration(seconds=…).to_msg() of "
            "rclpy.duration.",
            at=each.t,
        )
    result = goal.result
    arrived = goal.status == SUCCEEDED and result is not None and life.near_arrival(goal, result.t)
    walked = life.is_undisturbed(goal) and arrived and is_slow and life.initial_distance(goal) >= FAR_DISTANCE
    if not walked or len(estimates) < MIN_FEEDBACK:
        return "on the way"
    quarter = len(estimates) // 4
    first, last = max(estimates[: 2 * quarter]), min(estimates[-quarter:])
    expect(
        last < first,
        expected="estimated_time_remaining to be smaller near the end than at first",
        observed=f"{first:.1f} s at first, {last:.1f} s near the end",
        help="It is the time that is left from now on, not the time of the whole walk nor the time since its start.",
        at=goal.feedback[-1].t,
    )
    return "a walk"


def feedback_ends_with_the_goal(goal: Goal) -> str | None:
    """After the result no more feedback comes."""
    if not life.accepted(goal) or goal.result is None or goal.run.end < goal.result.t + LISTENING_TIME:
        return None
    if not goal.feedback:
        return None
    end = goal.result.t
    late = [feedback for feedback in goal.feedback if feedback.t > end + DELIVERY_SLACK]
    expect(
        not late,
        expected="no feedback after the result",
        observed=f"{len(late)} message(s), the last {late[-1].t - end:.1f} s after it" if late else "",
        help="Stop the timer or thread that publishes feedback before the terminal call.",
        at=late[0].t if late else None,
    )
    return name_of(GoalStatus, goal.result.status)


def names_no_error(goal: Goal) -> str | None:
    """The error_code of a goal that is not ABORTED is NONE."""
    if not life.accepted(goal) or goal.result is None:
        return None
    if goal.status not in life.TERMINAL or life.interrupted(goal):
        return None
    status = name_of(GoalStatus, goal.result.status)
    if goal.status != ABORTED:
        reports.require_error_code(goal, "NONE", because=f"the goal is {status}")
    return status


def reports_where_it_ended(goal: Goal) -> str | None:
    """The result holds where the robot ended, the steps for this goal, and the error_code of its status."""
    status = names_no_error(goal)
    if status:
        reports.require_true_result(goal)
    return status


def says_why_it_aborted(goal: Goal) -> str | None:
    """A goal that is ABORTED says why, in error_msg."""
    if goal.status != ABORTED or not life.accepted(goal) or life.interrupted(goal):
        return None
    assert goal.result
    expect(
        bool(goal.result.result.error_msg.strip()),
        expected="a sentence in error_msg",
        observed="an empty text",
        help=why_rclpy_aborted(goal)
        or "Describe in result.error_msg what happened, before you call abort().",
        at=goal.result.t,
    )
    return "aborted"


def seconds(duration: Duration) -> float:
    """Return a duration in s."""
    return float(duration.sec + duration.nanosec * 1e-9)
