"""The requirements on an arm: its trajectory, its final position, and the feedback and result about it."""

from __future__ import annotations

from typing import Any

import pytest
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from autograder.authoring.evidence import events as ev
from humanoid_interfaces.action import MoveArm
from records import failure_of, run_of
from robot_sim.arms.joint_trajectory import MOVABLE
from robot_sim.humanoid import Humanoid
from solutions.move_arm import ends, motion, reports
from solutions.move_arm.objections import RANGES
from solutions.move_arm.plan import Plan

ELBOW = "l_elbow"
START, HALF, END = -0.5, -1.5, -1.0  # rad, at 0, 2 and 4 s
HELD, FAR = -1.0, -2.3  # rad
BEGIN = 2.0  # s


def trajectory(*points: tuple[int, float]) -> JointTrajectory:
    return JointTrajectory(
        joint_names=[ELBOW],
        points=[
            JointTrajectoryPoint(positions=[place], time_from_start=Duration(sec=sec))
            for sec, place in points or ((2, HALF), (4, END))
        ],
    )


def wanted(t: float) -> float:
    return Plan.of(trajectory(), {ELBOW: START}, BEGIN).at(t)[ELBOW]


def moved(place: Any, *more: Any, end: float = 6.1, **result: Any) -> Any:
    """A run in which the elbow was at place(t) and the goal succeeded at `end` (s)."""
    reports = [
        ev.JointsTruth(
            t=0.02 * k,
            positions={ELBOW: place(0.02 * k)},
            velocities={ELBOW: 50 * (place(0.02 * k) - place(0.02 * (k - 1)))},
        )
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


def held(said: str, afterwards: float = HELD) -> Any:
    """A run in which the elbow was held from 3 s to 5 s during a long motion; then it turned to `afterwards`."""
    hold = ev.RobotCommanded(t=3.0, command={"do": "hold_joint", "joint": ELBOW})
    release = ev.RobotCommanded(t=5.0, command={"do": "release_joint", "joint": ELBOW})

    def place(t: float) -> float:
        return follows(t) if t < 3.0 else HELD if t < 5.0 else afterwards

    run = given_up(place, MoveArm.Result.PATH_TOLERANCE_VIOLATED, hold, release, after=2.3, said=said)
    run.goal("move").request.trajectory = trajectory((4, FAR))
    return run


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
    assert ends.succeeds(run.goal("move")) == "unhindered; at first"
    assert motion.passes_every_point(run.goal("move")) == "2 points, unhindered"


def test_an_arm_away_from_its_goal_has_not_arrived() -> None:
    run = moved(lambda t: follows(t) - 0.2)
    assert "l_elbow was 0.20 rad away" in failure_of(ends.succeeds, run.goal("move")).observed


def test_success_before_the_last_points_time_is_too_early_and_long_after_it_too_late() -> None:
    assert (
        "SUCCEEDED 2.0 s before" in failure_of(ends.succeeds, moved(follows, end=4.0).goal("move")).observed
    )
    assert "SUCCEEDED 3.0 s after" in failure_of(ends.succeeds, moved(follows, end=9.0).goal("move")).observed


def test_a_point_that_is_left_out_is_missed() -> None:
    run = moved(lambda t: START if t < BEGIN else END)
    assert "0.50 rad" in failure_of(motion.passes_every_point, run.goal("move")).observed


def test_true_feedback_passes_and_false_does_not() -> None:
    good = [told(3.0, 0, 0.02, 25.0), told(5.0, 1, 0.02, 75.0)]
    assert reports.feedback_is_true(moved(follows, *good).goal("move")) == "unhindered"
    for bad, word in (
        (told(3.0, 1, 0.02, 25.0), "waypoint"),
        (told(3.0, 0, 1.0, 25.0), "max_error"),
        (told(5.0, 1, 0.02, 0.75), "progress"),
        (told(5.0, 1, 0.02, 140.0), "progress"),
    ):
        failure = failure_of(reports.feedback_is_true, moved(follows, bad).goal("move"))
        assert word in failure.expected, failure


def asked_to_cancel(t: float, place: Any) -> Any:
    """A run in which the goal was cancelled at `t` s, and the elbow was at place(t)."""
    events = [event for event in moved(place).events if not isinstance(event, ev.ResultReceived)]
    return run_of(
        *events,
        ev.CancelSent(t=t, cancel="cancel", goal="move", by="client"),
        ev.CancelAnswered(t=t + 0.1, cancel="cancel", return_code=0, canceling=["move"]),
        ev.ResultReceived(t=t + 0.2, goal="move", status=GoalStatus.STATUS_CANCELED, result=MoveArm.Result()),
        until=9.5,
    )


def test_an_arm_that_turns_on_has_not_stopped() -> None:
    failure = failure_of(motion.stops_when_canceled, asked_to_cancel(2.8, follows).goal("move"))
    assert "l_elbow turned at 0.50 rad/s" in failure.observed
    stopped = asked_to_cancel(2.8, lambda t: follows(min(t, 3.0)))
    assert ends.grants_cancels(stopped.goal("move")) == "on the way"
    assert motion.stops_when_canceled(stopped.goal("move")) == "alone"


@pytest.mark.parametrize(
    ("said", "word"),
    [("", "''"), ("l_elbow_2 is off", "l_elbow_2"), ("l_elbow and l_wrist_yaw", "it also names l_wrist_yaw")],
)
def test_a_result_names_one_joint(said: str, word: str) -> None:
    assert word in failure_of(reports.names_the_joint, held(said).goal("move")).observed


def test_a_named_joint_is_found() -> None:
    assert reports.names_the_joint(held("l_elbow: 0.5 rad off").goal("move")) == "1 blocked"


def test_a_blocked_arm_strays_and_one_that_goes_on_later_has_not_held() -> None:
    goal = held("l_elbow").goal("move")
    assert ends.strays(goal) == "blocked"
    assert motion.holds_when_given_up(goal) == "released"
    assert "moved on" in failure_of(motion.holds_when_given_up, held("l_elbow", FAR).goal("move")).observed


def silenced(code: int) -> Any:
    """A goal of a slow motion that was aborted 1.3 s after joint_states stopped; the arm holds from then on."""
    lost = ev.RobotCommanded(t=4.0, command={"do": "joint_sensors", "connected": False})
    run = given_up(lambda t: START - 0.15 * min(max(t - BEGIN, 0.0), 3.3), code, lost, after=3.3)
    run.goal("move").request.trajectory = trajectory((8, START - 1.2))
    return run.goal("move")


def test_missing_joint_states_have_an_error_code_of_their_own() -> None:
    goal = silenced(MoveArm.Result.INVALID_JOINTS)
    assert ends.notices_silence(goal) == "on the way"
    assert motion.holds_when_given_up(goal) == "without joint_states"
    failure = failure_of(ends.notices_silence, silenced(MoveArm.Result.PATH_TOLERANCE_VIOLATED))
    assert "INVALID_JOINTS" in failure.expected


def test_the_ranges_are_the_robots() -> None:
    model = Humanoid().model
    assert {joint for joint in MOVABLE if joint in RANGES} == set(RANGES)
    for joint, limits in RANGES.items():
        assert tuple(model.joint(joint).range) == pytest.approx(limits)


def behind(t: float) -> float:
    return follows(t) + 0.3 * min(1.0, max(0.0, t - BEGIN))


@pytest.mark.parametrize(
    ("run", "word"),
    [
        (given_up(follows, MoveArm.Result.PREEMPTED), "newest goal of each arm"),
        (given_up(follows, MoveArm.Result.INVALID_JOINTS), "num_threads"),
        (
            given_up(follows, MoveArm.Result.PATH_TOLERANCE_VIOLATED, after=1.0),
            "the largest error was 0.00 rad",
        ),
        (given_up(behind, MoveArm.Result.PATH_TOLERANCE_VIOLATED, after=1.0), "did not receive all of it"),
        (given_up(follows, MoveArm.Result.GOAL_TOLERANCE_VIOLATED), "0 rad, which means 0.05"),
        (
            given_up(behind, MoveArm.Result.GOAL_TOLERANCE_VIOLATED, tolerance=0.4),
            "goal_tolerance is 0.4 rad",
        ),
        (given_up(behind, MoveArm.Result.GOAL_TOLERANCE_VIOLATED, after=4.2), "have 1 s to arrive"),
        (
            given_up(behind, MoveArm.Result.GOAL_TOLERANCE_VIOLATED),
            "too, l_elbow was 0.30 rad from the last point",
        ),
    ],
)
def test_an_aborted_goal_is_explained_by_its_code_and_the_arms_position(run: Any, word: str) -> None:
    assert word in failure_of(ends.succeeds, run.goal("move")).help
