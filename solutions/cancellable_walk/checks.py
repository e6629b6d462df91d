"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario, check, expect
from autograder.authoring.feedback import require_good_feedback_rate
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.aborts import require_aborted_by_a_fall, require_preempted
from autograder.authoring.walking.reports import (
    require_filled_result,
    require_true_feedback,
)
from autograder.authoring.walking.truth import (
    require_accepted,
    require_arrival,
    require_stopped,
    require_walking,
)

WALK = Scenario("walk", {"x": 0.6, "y": 0.2, "yaw": 0.5})
IMPOSSIBLE = Scenario("ask_for_the_impossible", {"frame": "map"}, robot=RESTING)
UNPOWERED = Scenario("ask_without_power")
MID_STRIDE = Scenario("cancel_in_mid_stride", {"delays": [1.0]})
WALK_AGAIN = Scenario("walk_again_after_a_cancel", {"x": 0.8, "y": 0.0, "yaw": 0.0})
PREEMPT = Scenario("preempt", {"x": 0.7, "y": 0.2, "yaw": 0.3})
FALL = Scenario("fall", {"impulse": [0.0, 60.0, 0.0]})
INTERRUPT = Scenario("interrupt", robot=RESTING)

KNOWN = 0.6  # s for a change of the robot to be known to the node


server_appears = standard.server_appears(
    "the action walk_to", points=1, on=INTERRUPT, see="07_cancel_and_preempt#fix-file"
)


@check(points=1, on=WALK, needs=server_appears, see="07_cancel_and_preempt#m2-why")
def accepts_a_goal(run: Transcript) -> None:
    """It accepts a pose in frame odom"""
    require_accepted(run.goal("walk"))


@check(points=2, on=WALK, needs=accepts_a_goal, see="07_cancel_and_preempt#fix-intro")
def arrives(run: Transcript) -> None:
    """It SUCCEEDS, and the robot is then within 0.10 m and 0.15 rad of the goal"""
    require_arrival(run.goal("walk"))


@check(points=1, on=WALK, needs=arrives, see="07_cancel_and_preempt#m13-why")
def fills_the_result(run: Transcript) -> None:
    """The result holds the final pose, the steps and error_code NONE"""
    require_filled_result(run.goal("walk"))


@check(points=1, on=WALK, needs=accepts_a_goal, see="07_cancel_and_preempt#conventions")
def feedback_keeps_its_rate(run: Transcript) -> None:
    """Feedback comes at 5 Hz without a gap over 1 s"""
    require_good_feedback_rate(run.goal("walk"))


@check(points=1, on=WALK, needs=feedback_keeps_its_rate, see="07_cancel_and_preempt#turner-intro")
def feedback_is_true(run: Transcript) -> None:
    """Pose, distance and steps in the feedback are the robot's"""
    require_true_feedback(run.goal("walk"))


feedback_ends_with_the_goal = standard.feedback_ends_with_the_goal(
    "walk", points=1, on=WALK, needs=[arrives, feedback_keeps_its_rate]
)


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_goal, see="07_cancel_and_preempt#conventions")
def rejects_a_wrong_frame(run: Transcript) -> None:
    """It rejects a pose in frame map"""
    run.goal("wrong frame").require_rejected(
        because="the robot knows no frame 'map'",
        help="Compare goal_request.target_pose.header.frame_id with 'odom' in goal_callback and return "
        "GoalResponse.REJECT.",
    )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_goal, see="07_cancel_and_preempt#conventions")
def rejects_nan(run: Transcript) -> None:
    """It rejects a pose that holds NaN"""
    for name in ("NaN position", "NaN orientation"):
        run.goal(name).require_rejected(
            because=f"{name} cannot be walked to",
            help="Test every number of position and orientation with math.isfinite() in goal_callback: NaN "
            "compares false with everything.",
        )


@check(points=1, on=UNPOWERED, needs=accepts_a_goal, see="07_cancel_and_preempt#conventions")
def rejects_without_power(run: Transcript) -> None:
    """It rejects a goal while the motors are off"""
    _require_power_cut(run)
    run.goal("unpowered").require_rejected(
        because="robot_state.motors_enabled is false",
        help="Subscribe to robot_state and reject in goal_callback when motors_enabled is false in the last "
        "message.",
    )


def _require_power_cut(run: Transcript) -> None:
    """Require that the motors were off when the goal came, and the robot had said so."""
    sent = run.goal("unpowered").sent
    run.told("motor_power", before=sent.t, on=False)
    powered = [robot for robot in run.robot_between(sent.t - KNOWN, sent.t) if robot.motors_enabled]
    expect(
        not powered,
        expected="the robot's motors off, as the grader has switched them",
        observed="they were switched on again",
        help="Publish nothing on motor_power: this node only walks.",
        at=sent.t,
    )


@check(points=2, on=MID_STRIDE, needs=accepts_a_goal, see="07_cancel_and_preempt#m1-why")
def cancels_in_mid_stride(run: Transcript) -> None:
    """A cancel while the robot walks is agreed to and ends CANCELED"""
    request = run.goal("after 1 s").require_canceled()
    require_walking(run, request.t)


@check(points=2, on=MID_STRIDE, needs=cancels_in_mid_stride, see="07_cancel_and_preempt#m12-robot-why")
def stops_when_canceled(run: Transcript) -> None:
    """Within 2 s of the cancel the robot stands still and upright"""
    request = run.goal("after 1 s").requests_to_cancel[-1].sent
    require_walking(run, request.t)
    require_stopped(run, request.t)


@check(points=1, on=WALK_AGAIN, needs=[cancels_in_mid_stride, arrives], see="07_cancel_and_preempt#fix-intro")
def walks_again_after_a_cancel(run: Transcript) -> None:
    """A new goal after a cancel is walked to"""
    require_walking(run, run.goal("canceled").requests_to_cancel[-1].sent.t)
    require_arrival(run.goal("again"))


@check(points=2, on=PREEMPT, needs=arrives, see="07_cancel_and_preempt#preempt-why")
def new_goal_preempts_the_old(run: Transcript) -> None:
    """A new goal aborts the old one with PREEMPTED and is walked to"""
    require_preempted(run.goal("old"), run.goal("new"))


@check(points=1, on=FALL, needs=accepts_a_goal, see="07_cancel_and_preempt#fall-why")
def aborts_when_the_robot_falls(run: Transcript) -> None:
    """When the robot falls the goal is ABORTED with FELL"""
    require_aborted_by_a_fall(run.goal("walk"))


ends_cleanly = standard.ends_cleanly(
    points=1, on=INTERRUPT, needs=server_appears, see="07_cancel_and_preempt#conventions"
)
