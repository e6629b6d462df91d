"""What is required of an arm: its plan, where it arrived, what was said of it."""

from __future__ import annotations

from typing import Any

import pytest
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from records import failure_of, run_of
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from autograder.authoring import events as ev
from autograder.authoring.arms.motion import require_arrival, require_points_passed, require_stopped
from autograder.authoring.arms.plan import Plan
from autograder.authoring.arms.reports import require_named, require_true_feedback
from humanoid_interfaces.action import MoveArm

ELBOW = "l_elbow"
START, HALF, END = -0.5, -1.5, -1.0  # rad, at 0, 2 and 4 s
BEGIN = 2.0  # s


def trajectory() -> JointTrajectory:
    points = [
        JointTrajectoryPoint(positions=[place], time_from_start=Duration(sec=sec))
        for sec, place in ((2, HALF), (4, END))
    ]
    return JointTrajectory(joint_names=[ELBOW], points=points)


def wanted(t: float) -> float:
    return Plan.of(trajectory(), {ELBOW: START}, BEGIN).at(t)[ELBOW]


def moved(place: Any, *more: Any, end: float = 6.1, **result: Any) -> Any:
    """A run in which the elbow was at place(t) and the goal succeeded at `end` (s)."""
    reports = [
        ev.JointsTruth(t=0.02 * k, positions={ELBOW: place(0.02 * k)}, velocities={ELBOW: 0.0})
        for k in range(500)
    ]
    request = MoveArm.Goal(arm="l", trajectory=trajectory())
    return run_of(
        *reports,
        ev.GoalSent(t=1.9, goal="move", action="move_arm", request=request),
        ev.GoalAnswered(t=BEGIN, goal="move", accepted=True),
        *more,
        ev.ResultReceived(
            t=end, goal="move", status=GoalStatus.STATUS_SUCCEEDED, result=MoveArm.Result(**result)
        ),
        until=9.5,
    )


def follows(t: float) -> float:
    return wanted(max(t, BEGIN))


def told(t: float, waypoint: int, error: float, progress: float) -> Any:
    feedback = MoveArm.Feedback(waypoint=waypoint, max_error=error, progress_percentage=progress)
    return ev.FeedbackReceived(t=t, goal="move", feedback=feedback)


def given_up(
    place: Any, code: int, *more: Any, after: float = 5.2, tolerance: float = 0.0, said: str = "?"
) -> Any:
    """A run in which the server aborted the goal, `after` s after its acceptance."""
    run = moved(place, *more)
    end = ev.ResultReceived(
        t=BEGIN + after,
        goal="move",
        status=GoalStatus.STATUS_ABORTED,
        result=MoveArm.Result(error_code=code, error_msg=said),
    )
    events = [event for event in run.events if not isinstance(event, ev.ResultReceived)]
    next(event for event in events if isinstance(event, ev.GoalSent)).request.goal_tolerance = tolerance
    return run_of(*events, end, until=9.5)


def held(said: str) -> Any:
    """A run in which the elbow was held, and the goal aborted with an error_msg."""
    hold = ev.RobotCommanded(t=3.0, command={"do": "hold_joint", "joint": ELBOW})
    return given_up(follows, MoveArm.Result.PATH_TOLERANCE_VIOLATED, hold, said=said)


def test_a_plan_goes_straight_from_point_to_point() -> None:
    plan = Plan.of(trajectory(), {ELBOW: START}, BEGIN)
    assert [round(plan.at(BEGIN + t)[ELBOW], 3) for t in (-1, 0, 1, 2, 3, 4, 9)] == [
        *(-0.5, -0.5, -1.0),
        *(-1.5, -1.25, -1.0, -1.0),
    ]
    assert [plan.point_at(BEGIN + t) for t in (0, 1.9, 2.1, 3.9, 9)] == [0, 0, 1, 1, 1]
    assert plan.end == BEGIN + 4


def test_an_arm_that_follows_has_arrived() -> None:
    run = moved(follows)
    require_arrival(run.goal("move"))
    require_points_passed(run.goal("move"))


def test_an_arm_that_is_not_there_has_not() -> None:
    run = moved(lambda t: follows(t) - 0.2)
    assert "l_elbow is 0.20 rad away" in failure_of(require_arrival, run.goal("move")).observed


def test_success_before_the_last_points_time_is_too_early() -> None:
    run = moved(follows, end=4.0)
    assert "SUCCEEDED 2.0 s before" in failure_of(require_arrival, run.goal("move")).observed


def test_a_point_that_is_left_out_is_missed() -> None:
    run = moved(lambda t: START if t < BEGIN else END)
    assert "0.50 rad" in failure_of(require_points_passed, run.goal("move")).observed


def test_true_feedback_passes_and_false_does_not() -> None:
    good = [told(3.0, 0, 0.02, 25.0), told(5.0, 1, 0.02, 75.0)]
    require_true_feedback(moved(follows, *good).goal("move"))
    for bad, word in (
        (told(3.0, 1, 0.02, 25.0), "waypoint"),
        (told(3.0, 0, 1.0, 25.0), "max_error"),
        (told(5.0, 1, 0.02, 0.75), "progress"),
        (told(5.0, 1, 0.02, 140.0), "progress"),
    ):
        failure = failure_of(require_true_feedback, moved(follows, *good[:0], bad).goal("move"))
        assert word in failure.expected, failure


def test_an_arm_that_turns_on_has_not_stopped() -> None:
    reports = [
        ev.JointsTruth(t=0.02 * k, positions={ELBOW: 0.0}, velocities={ELBOW: 0.3}) for k in range(500)
    ]
    failure = failure_of(require_stopped, run_of(*reports, until=9.5), [ELBOW], 3.0)
    assert "l_elbow turns at 0.30 rad/s" in failure.observed


@pytest.mark.parametrize(
    ("said", "word"),
    [("", "''"), ("l_elbow_2 is off", "l_elbow_2"), ("l_elbow and l_wrist_yaw", "it also names l_wrist_yaw")],
)
def test_a_result_names_one_joint(said: str, word: str) -> None:
    run = held(said)
    assert word in failure_of(require_named, run.goal("move"), ELBOW, ["l_wrist_yaw"]).observed


def test_a_named_joint_is_found() -> None:
    require_named(held("l_elbow: 0.5 rad off").goal("move"), ELBOW, ["l_wrist_yaw"])


def behind(t: float) -> float:
    return follows(t) + 0.3 * min(1.0, max(0.0, t - BEGIN))


@pytest.mark.parametrize(
    ("run", "word"),
    [
        (given_up(follows, MoveArm.Result.PREEMPTED), "newest goal of each arm"),
        (given_up(follows, MoveArm.Result.INVALID_JOINTS), "num_threads"),
        (given_up(follows, MoveArm.Result.PATH_TOLERANCE_VIOLATED, after=1.0), "0.00 rad off its trajectory"),
        (given_up(behind, MoveArm.Result.PATH_TOLERANCE_VIOLATED, after=1.0), "did not get all of it"),
        (given_up(follows, MoveArm.Result.GOAL_TOLERANCE_VIOLATED), "0 rad, which means 0.05"),
        (
            given_up(behind, MoveArm.Result.GOAL_TOLERANCE_VIOLATED, tolerance=0.4),
            "goal_tolerance is 0.4 rad",
        ),
        (given_up(behind, MoveArm.Result.GOAL_TOLERANCE_VIOLATED, after=4.2), "has 1 s more"),
        (given_up(behind, MoveArm.Result.GOAL_TOLERANCE_VIOLATED), "0.30 rad from the last point, too"),
    ],
)
def test_why_a_goal_was_given_up_is_told_by_its_code_and_by_where_the_arm_was(run: Any, word: str) -> None:
    assert word in failure_of(require_arrival, run.goal("move")).help
