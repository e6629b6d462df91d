"""Goals of navigate_to_pose are judged by their own tolerance and by the operator's actions during each goal."""

from __future__ import annotations

import pytest

from autograder.arena.poses import pose_at
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.authoring.walking.obligations import ends
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState
from records import robot
from ros_runtime.message_constants import GoalStatus
from solutions.navigate_to_pose import model
from solutions.navigate_to_pose.legs import operated

END = 60.0  # s
PERIOD = 0.05  # s between two samples of the robot


def run_of(*events, x=0.9, walked=10.0, steps=()):
    """A run in which the robot walks from 0 to x (m) in the given time (s) and stands afterwards."""
    truths = []
    for k in range(round(END / PERIOD) + 1):
        t = k * PERIOD
        mode = RobotState.WALKING if t < walked else RobotState.STANDING
        truths.append(robot(t, mode=mode, x=x * min(1.0, t / walked), steps=int(2 * min(t, walked))))
    events = [ev.NodeStarted(t=0.0), *events, *truths, ev.ScenarioEnded(t=END)]
    return Transcript.from_events("in_order", {"steps": steps}, events)


def goal(name="go", sent=0.0, x=1.0, tolerance=0.0):
    request = NavigateToPose.Goal(pose=pose_at(x, 0.0, 0.0), tolerance=tolerance)
    return (
        ev.GoalSent(t=sent, goal=name, action="navigate_to_pose", request=request),
        ev.GoalAnswered(t=sent, goal=name, accepted=True),
    )


def ended(t, name="go", status=GoalStatus.SUCCEEDED, code=NavigateToPose.Result.NONE, traveled=0.9):
    result = NavigateToPose.Result(error_code=code, distance_traveled=traveled)
    return ev.ResultReceived(t=t, goal=name, status=status, result=result)


def said(t, name="go", progress=0.0, recoveries=0):
    feedback = NavigateToPose.Feedback(progress_percentage=progress, number_of_recoveries=recoveries)
    feedback.navigation_time.sec = int(t)
    return ev.FeedbackReceived(t=t, goal=name, feedback=feedback)


@pytest.mark.parametrize(("tolerance", "is_there"), [(0.0, False), (0.05, False), (0.2, True)])
def test_a_goal_is_reached_within_its_own_tolerance(tolerance, is_there):
    run = run_of(*goal(tolerance=tolerance), ended(12.0), x=0.88)
    if is_there:
        assert ends.succeeds(run.goal("go"))
    else:
        with pytest.raises(Failure, match="within 0"):
            ends.succeeds(run.goal("go"))


def test_the_operator_disturbs_the_goal_that_is_under_way_and_no_other():
    steps = [["go", "go", 1.0, 0.0, 0.0], ["lead_astray", 4.0, 1], ["go_on", "next", 0.4, 0.0, 0.0], ["hold"]]
    run = run_of(*goal(), *goal("next", 30.0), steps=steps)
    for name, how, other in (("go", "lead_astray", "hold"), ("next", "hold", "lead_astray")):
        assert operated(run.goal(name), how)
        assert not operated(run.goal(name), other)


def test_the_path_is_what_was_walked_however_the_goal_ends():
    assert model.measures_its_path.require(run_of(*goal(), ended(12.0)).goal("go")) == "SUCCEEDED, at first"
    for traveled in (0.5, 1.3):
        with pytest.raises(Failure, match="distance_traveled"):
            model.measures_its_path.require(run_of(*goal(), ended(12.0, traveled=traveled)).goal("go"))
    canceled = ended(12.0, status=GoalStatus.CANCELED, traveled=0.5)
    # the last part of the path may not be counted
    assert model.measures_its_path.require(run_of(*goal(), canceled).goal("go"))


def test_progress_and_recoveries_are_of_this_goal():
    reports = [said(1.0, progress=10.0), said(11.0, progress=100.0)]
    run = run_of(*goal(), *reports, ended(12.0))
    assert model.progress_rises.require(run.goal("go")) == "SUCCEEDED"
    assert model.counts_no_recovery.require(run.goal("go")) == "at first"
    assert model.tells_its_time.require(run.goal("go")) == "at first"
    with pytest.raises(Failure, match="never to fall"):
        model.progress_rises.require(
            run_of(*goal(), *reports, said(11.5, progress=99.0), ended(12.0)).goal("go")
        )
    with pytest.raises(Failure, match="number_of_recoveries 0"):
        model.counts_no_recovery.require(run_of(*goal(), said(1.0, recoveries=1), ended(12.0)).goal("go"))


def test_a_goal_has_30_s_and_15_s_per_metre():
    def gives_up(after, status=GoalStatus.ABORTED, code=NavigateToPose.Result.TIMEOUT):
        return model.gives_up_in_time.require(
            run_of(*goal(), ended(after, status=status, code=code)).goal("go")
        )

    assert gives_up(46.0)
    assert gives_up(12.0, GoalStatus.SUCCEEDED, NavigateToPose.Result.NONE) is None
    for too_early_or_late in (31.0, 55.0):
        with pytest.raises(Failure, match="TIMEOUT 45 s after acceptance"):
            gives_up(too_early_or_late)
    with pytest.raises(Failure, match="ABORTED"):
        gives_up(55.0, GoalStatus.SUCCEEDED, NavigateToPose.Result.NONE)
