"""The obligations of every walking goal, judged by its active time and the robot's motion in that time."""

from __future__ import annotations

import math

import pytest

from autograder.arena.poses import pose_at
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.authoring.walking import objections
from autograder.authoring.walking.objections import accepting, one_of_several, rejects
from autograder.authoring.walking.obligations import cancels, ends, reporting, walks
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from records import failure_of, robot
from ros_runtime.message_constants import GoalStatus

ACCEPTS = accepting(
    objections.frames,
    objections.nan,
    objections.no_rotation,
    objections.velocities,
    objections.without_power,
    objections.while_busy,
)
PERIOD = 0.02  # s between two samples of the robot
END = 30.0  # s


def a_walk(start, x0, x1, speed=0.2):
    """A walk from x0 to x1 (m) that begins at `start` (s): two steps a second."""

    def at(t):
        way = min(abs(x1 - x0), max(0.0, speed * (t - start)))
        under_way = 0.0 < way < abs(x1 - x0)
        return math.copysign(way, x1 - x0), round(way / speed * 2), under_way

    return at


def run_of(*events, motions=(), down=math.inf):
    """A run with a robot that makes these walks, one after the other, and has fallen from `down` (s) on."""
    truths = []
    for k in range(round(END / PERIOD) + 1):
        t = k * PERIOD
        parts = [motion(t) for motion in motions]
        walking_now = any(part[2] for part in parts)
        mode = RobotState.FALLEN if t >= down else RobotState.WALKING if walking_now else RobotState.STANDING
        x, steps = (sum(part[index] for part in parts) for index in (0, 1))
        truths.append(robot(t, x=x, steps=steps, mode=mode, motors=t < down, speed=0.2 * walking_now))
    started = ev.NodeStarted(t=0.0)
    return Transcript.from_events("in_order", {}, [started, *events, *truths, ev.ScenarioEnded(t=END)])


def goal(name, sent, x, *, fastest=0.0, accepted=True, frame="odom"):
    request = WalkTo.Goal(target_pose=pose_at(x, 0.0, 0.0, frame), max_velocity=fastest)
    return (
        ev.GoalSent(t=sent, goal=name, action="walk_to", request=request),
        ev.GoalAnswered(t=sent + 0.1, goal=name, accepted=accepted),
    )


def ended(name, t, x, steps, status=GoalStatus.SUCCEEDED, code=WalkTo.Result.NONE, message=""):
    result = WalkTo.Result(
        final_pose=pose_at(x, 0.0, 0.0), total_steps=steps, error_code=code, error_msg=message
    )
    return ev.ResultReceived(t=t, goal=name, status=status, result=result)


def canceled(name, sent, granted):
    return (
        ev.CancelSent(t=sent, cancel=f"cancel of {name}", goal=name, by="client"),
        ev.CancelAnswered(
            t=sent + 0.1, cancel=f"cancel of {name}", return_code=0, canceling=[name] if granted else []
        ),
    )


def said(name, t, x, left, steps, seconds):
    feedback = WalkTo.Feedback(current_pose=pose_at(x, 0.0, 0.0), distance_remaining=left, steps_taken=steps)
    feedback.estimated_time_remaining.sec = seconds
    return ev.FeedbackReceived(t=t, goal=name, feedback=feedback)


TWO_WALKS = (a_walk(1.2, 0.0, 0.97), a_walk(10.2, 0.97, 1.47))  # 10 steps, then 5


def two_goals(final_pose=1.47, steps=5):
    return run_of(
        *goal("first", 1.0, 1.0),
        ended("first", 8.0, 0.97, 10),
        *goal("second", 10.0, 1.5),
        ended("second", 15.0, final_pose, steps),
        motions=TWO_WALKS,
    )


def test_a_result_holds_what_was_measured_for_its_own_goal():
    run = two_goals()
    for each in ("first", "second"):
        assert ends.succeeds(run.goal(each))
        assert reporting.reports_where_it_ended(run.goal(each)) == "SUCCEEDED"


def test_a_final_pose_that_repeats_the_goal_is_named():
    with pytest.raises(Failure, match="m are forgiven") as failed:
        reporting.reports_where_it_ended(two_goals(final_pose=1.5).goal("second"))
    assert "the pose that the goal asked for" in failed.value.help


def test_steps_counted_since_the_reset_are_named():
    with pytest.raises(Failure, match="since the robot was reset"):
        reporting.reports_where_it_ended(two_goals(steps=15).goal("second"))


def test_a_goal_is_rejected_for_the_state_at_its_arrival():
    run = run_of(
        *goal("walk", 1.0, 3.0),
        *goal("second", 3.0, 0.5, accepted=False),
        *goal("in map", 5.0, 0.5, frame="map", accepted=False),
        motions=[a_walk(1.2, 0.0, 3.0)],
        down=8.0,
    )
    assert ACCEPTS(run.goal("walk")) == "at first"
    assert ACCEPTS(run.goal("second")) is None
    assert rejects(1, objections.while_busy).require(run.goal("second")) == "while another is active"
    assert rejects(1, objections.frames).require(run.goal("in map"))
    assert ends.goes_on(run.goal("walk")) == "another was rejected"


def test_a_goal_without_a_reason_for_rejection_has_to_be_accepted():
    run = run_of(
        *goal("walk", 1.0, 1.0), ended("walk", 8.0, 0.97, 10), *goal("next", 10.0, 1.5, accepted=False)
    )
    with pytest.raises(Failure, match="it was rejected"):
        ACCEPTS(run.goal("next"))


def test_a_goal_that_arrives_as_another_ends_may_get_either_answer():
    run = run_of(
        *goal("walk", 1.0, 1.0), ended("walk", 8.0, 0.97, 10), *goal("next", 8.1, 1.5, accepted=False)
    )
    assert ACCEPTS(run.goal("next")) is None
    assert rejects(1, objections.while_busy).require(run.goal("next")) is None


def test_a_preempted_goal_was_active():
    gone = ended("walk", 3.15, 0.4, 4, status=GoalStatus.ABORTED)
    run = run_of(*goal("walk", 1.0, 2.0), *goal("second", 3.0, 0.5), gone, motions=[a_walk(1.2, 0.0, 0.4)])
    with pytest.raises(Failure, match="it was accepted"):
        rejects(1, objections.while_busy).require(run.goal("second"))


@pytest.mark.parametrize(("answers", "taken"), [((True, True), 2), ((False, False), 0)])
def test_one_of_two_simultaneous_goals_is_accepted(answers, taken):
    one, other = goal("one", 1.0, 1.0, accepted=answers[0]), goal("other", 1.01, 1.0, accepted=answers[1])
    with pytest.raises(Failure, match=f"{taken} of 2 were accepted"):
        one_of_several(run_of(*one, *other).goal("one"))
    assert one_of_several(run_of(*one, *goal("other", 1.01, 1.0, accepted=not answers[0])).goal("one"))


def test_a_cancel_is_granted_and_the_robot_stops():
    events = (*goal("walk", 1.0, 2.0), *canceled("walk", 3.0, granted=True))
    run = run_of(
        *events, ended("walk", 4.0, 0.4, 4, status=GoalStatus.CANCELED), motions=[a_walk(1.2, 0.0, 0.4)]
    )
    assert cancels.grants_cancels(run.goal("walk")) == "in mid-stride"
    assert cancels.stops_when_canceled(run.goal("walk"))
    goes_on = run_of(
        *events, ended("walk", 4.0, 0.4, 4, status=GoalStatus.CANCELED), motions=[a_walk(1.2, 0.0, 3.0)]
    )
    with pytest.raises(Failure, match="after the cancel"):
        cancels.stops_when_canceled(goes_on.goal("walk"))
    with pytest.raises(Failure, match="while no goal is active"):
        walks.stands_without_a_goal(goes_on)


def test_a_robot_that_the_server_itself_brings_down_was_canceled_and_did_not_stop():
    run = run_of(
        *(*goal("walk", 1.0, 2.0), *canceled("walk", 3.0, granted=True)),
        ended("walk", 3.2, 0.4, 4, status=GoalStatus.CANCELED),
        motions=[a_walk(1.2, 0.0, 0.4)],
        down=3.5,
    )
    assert cancels.grants_cancels(run.goal("walk")) == "in mid-stride"
    with pytest.raises(Failure, match="it fell"):
        cancels.stops_when_canceled(run.goal("walk"))


def test_a_cancel_that_is_refused_changes_nothing():
    run = run_of(
        *(*goal("walk", 1.0, 2.0), *canceled("walk", 3.0, granted=False)),
        ended("walk", 4.0, 0.4, 4, status=GoalStatus.ABORTED),
        motions=[a_walk(1.2, 0.0, 0.4)],
    )
    assert cancels.refuses_cancels(run.goal("walk"))
    with pytest.raises(Failure, match="it ended ABORTED"):
        ends.goes_on(run.goal("walk"))


def test_the_newest_goal_controls_the_robot():
    events = (*goal("old", 1.0, 2.0), *goal("new", 3.0, 1.0))
    gone = ended("old", 3.3, 0.4, 4, GoalStatus.ABORTED, WalkTo.Result.PREEMPTED, "a newer goal")
    run = run_of(*events, gone, ended("new", 9.0, 1.0, 6), motions=[a_walk(1.2, 0.0, 1.0)])
    assert ends.gives_way(run.goal("old")) == "by 1 newer"
    assert reporting.says_why_it_aborted(run.goal("old"))
    with pytest.raises(Failure, match="error_msg"):
        reporting.says_why_it_aborted(
            run_of(
                *events, ended("old", 3.3, 0.4, 4, GoalStatus.ABORTED, 2), motions=[a_walk(1.2, 0.0, 1.0)]
            ).goal("old")
        )


def test_a_rejected_goal_preempts_no_other():
    run = run_of(
        *goal("in map", 1.0, 1.0, frame="map", accepted=False),
        *(*goal("walk", 3.0, 1.0), ended("walk", 9.0, 0.97, 10)),
        motions=[a_walk(3.2, 0.0, 0.97)],
    )
    assert ends.gives_way(run.goal("in map")) is None
    assert ends.succeeds(run.goal("walk"))


def test_a_goal_preempted_by_a_rejected_one_is_named():
    run = run_of(
        *(*goal("walk", 1.0, 2.0), *goal("in map", 3.0, 0.5, frame="map", accepted=False)),
        ended("walk", 3.3, 0.4, 4, GoalStatus.ABORTED, WalkTo.Result.PREEMPTED, "a newer goal"),
        motions=[a_walk(1.2, 0.0, 0.4)],
    )
    with pytest.raises(Failure, match="no other was accepted"):
        ends.gives_way(run.goal("walk"))
    with pytest.raises(Failure, match="it ended ABORTED"):
        ends.goes_on(run.goal("walk"))


def test_after_a_fall_only_the_error_code_is_checked():
    fell = ended("walk", 4.2, 0.6, 6, GoalStatus.ABORTED, WalkTo.Result.FELL, "it fell")
    run = run_of(*goal("walk", 1.0, 2.0), fell, motions=[a_walk(1.2, 0.0, 2.0)], down=4.0)
    assert ends.tells_a_fall(run.goal("walk")) == "pushed"
    assert ends.succeeds(run.goal("walk")) is None


def test_what_a_goal_becomes_after_ctrl_c_is_not_judged():
    run = run_of(
        *(*goal("walk", 1.0, 2.0), ev.NodeSignalled(t=3.0, signal="SIGINT")),
        ended("walk", 3.1, 0.0, 0, status=GoalStatus.ABORTED),
        motions=[a_walk(1.2, 0.0, 0.4)],
    )
    for require in (ends.succeeds, reporting.reports_where_it_ended, reporting.says_why_it_aborted):
        assert require(run.goal("walk")) is None


@pytest.mark.parametrize("estimate", [lambda left: 0, lambda left: 3, lambda left: int(-left)])
def test_an_invalid_estimate_is_named(estimate):
    times = [1.3 + 0.2 * k for k in range(25)]
    lefts = [max(0.03, 1.0 - 0.2 * (t - 1.2)) for t in times]
    feedback = [
        said("walk", t, 1.0 - left, left, 0, estimate(left)) for t, left in zip(times, lefts, strict=True)
    ]
    run = run_of(
        *goal("walk", 1.0, 1.0), *feedback, ended("walk", 8.0, 0.97, 10), motions=[a_walk(1.2, 0.0, 0.97)]
    )
    assert "estimated_time_remaining" in failure_of(reporting.estimates_the_time, run.goal("walk")).expected
