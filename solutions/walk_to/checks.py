"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario, check, expect
from autograder.authoring.feedback import require_good_feedback_rate
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.aborts import require_aborted_by_a_fall
from autograder.authoring.walking.halt import require_final_zero, require_standing_at_success
from autograder.authoring.walking.motion import require_limited_velocity, require_reached
from autograder.authoring.walking.reports import (
    require_filled_result,
    require_true_feedback,
)
from autograder.authoring.walking.truth import (
    require_accepted,
    require_arrival,
    require_walking,
)

from .judging import require_rejected_until, require_under_way, require_undisturbed

WALK = Scenario("walk", {"x": 0.6, "y": 0.2, "yaw": 0.5, "max_velocity": 0.15})
IMPOSSIBLE = Scenario("ask_for_the_impossible", {"frame": "map"}, robot=RESTING)
BEFORE_ODOM = Scenario("ask_before_the_first_odom", robot=None)
UNPOWERED = Scenario("ask_without_power", robot=None)
INTERFERE = Scenario("interfere")
FALL = Scenario("fall", {"impulse": [0.0, 60.0, 0.0], "max_velocity": 0.3})
INTERRUPT = Scenario("interrupt", robot=RESTING)

server_appears = standard.server_appears(
    "the action walk_to", points=1, on=INTERRUPT, see="06_walk_to_a_pose#small-intro"
)


@check(points=1, on=WALK, needs=server_appears, see="06_walk_to_a_pose#reject-task")
def accepts_a_goal(run: Transcript) -> None:
    """It accepts a pose in frame odom"""
    require_accepted(run.goal("walk"))


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_goal, see="06_walk_to_a_pose#reject-task")
def rejects_a_wrong_frame(run: Transcript) -> None:
    """It rejects a pose in frame map"""
    run.goal("wrong frame").require_rejected(
        because="the robot knows no frame 'map'",
        help="Compare request.target_pose.header.frame_id with 'odom', and return GoalResponse.REJECT.",
    )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_goal, see="06_walk_to_a_pose#reject-task")
def rejects_nan(run: Transcript) -> None:
    """It rejects a pose that holds NaN"""
    for name in ("NaN position", "NaN orientation"):
        run.goal(name).require_rejected(
            because=f"{name} cannot be walked to",
            help="Test every number of position and orientation with math.isfinite() in goal_callback: NaN "
            "compares false with everything.",
        )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_goal, see="06_walk_to_a_pose#reject-task")
def rejects_what_is_no_rotation(run: Transcript) -> None:
    """It rejects an orientation of four zeros"""
    run.goal("zero quaternion").require_rejected(
        because="x, y, z and w are all 0, which is no rotation",
        help="Four zeros are no rotation, and no heading to turn to: reject it when x² + y² + z² + w² is not about 1.",
    )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_goal, see="06_walk_to_a_pose#reject-task")
def rejects_a_senseless_velocity(run: Transcript) -> None:
    """It rejects a max_velocity that is negative or NaN"""
    for name, value in (("negative velocity", "below 0"), ("NaN velocity", "NaN")):
        run.goal(name).require_rejected(
            because=f"max_velocity is {value}",
            help="Accept max_velocity only if math.isfinite(v) and v >= 0.0: NaN < 0.0 is false, too.",
        )


@check(points=1, on=BEFORE_ODOM, needs=accepts_a_goal, see="06_walk_to_a_pose#reject-task")
def rejects_before_the_first_odom(run: Transcript) -> None:
    """It rejects goals before the first odom, and accepts them after it"""
    require_rejected_until(
        run,
        "before odom",
        "after odom",
        topic="odom",
        because="no odom has come, so nobody knows where the robot is",
        help="Keep None until the first odom arrives, and reject while it is None.",
    )


@check(points=1, on=UNPOWERED, needs=accepts_a_goal, see="06_walk_to_a_pose#reject-task")
def rejects_without_power(run: Transcript) -> None:
    """It rejects a goal while the motors are off, and accepts it when they are on"""
    require_rejected_until(
        run,
        "without power",
        "with power",
        topic="robot_state",
        because="robot_state.motors_enabled is false",
        help="Keep the last robot_state, and reject while its motors_enabled is false.",
    )


@check(points=1, on=INTERFERE, needs=accepts_a_goal, see="07_cancel_and_preempt#m1-why")
def refuses_a_cancel(run: Transcript) -> None:
    """It refuses to cancel, and the goal goes on"""
    goal = run.goal("walk").require_accepted()
    cancel = goal.requests_to_cancel[-1]
    require_under_way(goal, at=cancel.sent.t)
    if cancel.answer is None:
        cancel.require_agreed(goal)  # says why nobody answered
        return
    expect(
        not cancel.answer.canceling,
        expected="the request to cancel refused (no goal in goals_canceling)",
        observed="it was accepted",
        help="Give ActionServer no cancel_callback: rclpy refuses every cancel then. Do not promise what execute does "
        "not do; chapter 7 is about it.",
        at=cancel.answer.t,
    )


@check(points=1, on=INTERFERE, needs=refuses_a_cancel, see="07_cancel_and_preempt#two-why")
def rejects_a_second_goal(run: Transcript) -> None:
    """A goal while another runs is rejected, and the first goes on"""
    second = run.goal("second")
    second.require_rejected(
        because="another goal is under way, and the robot has one pair of legs",
        help="Remember in goal_callback that a goal was accepted, forget it when execute ends, and reject meanwhile. "
        "Callback groups do not do that: each accepted goal gets a thread of its own.",
    )
    require_undisturbed(
        run.goal("walk"),
        what="the second was rejected",
        at=second.sent.t,
        help="Leave the first goal alone when another is rejected.",
    )


@check(points=2, on=WALK, needs=accepts_a_goal, see="01_robot_and_graph#frames-intro")
def walks_to_the_goal(run: Transcript) -> None:
    """It walks: the robot comes within 0.10 m and 0.15 rad of the goal"""
    require_reached(run.goal("walk"))


@check(points=1, on=WALK, needs=walks_to_the_goal, see="01_robot_and_graph#frames-intro")
def obeys_max_velocity(run: Transcript) -> None:
    """On the way it is no faster than max_velocity"""
    require_limited_velocity(run.goal("walk"))


@check(points=1, on=INTERFERE, needs=accepts_a_goal, see="01_robot_and_graph#listen-intro")
def chooses_its_own_velocity(run: Transcript) -> None:
    """With max_velocity 0 it walks at a velocity of its own"""
    goal = run.goal("walk")
    if goal.request.max_velocity != 0.0:
        raise unseen(run, "the goal had a max_velocity")
    require_walking(run, goal.requests_to_cancel[0].sent.t)


@check(points=2, on=WALK, needs=walks_to_the_goal, see="06_walk_to_a_pose#settle-why")
def arrives(run: Transcript) -> None:
    """It SUCCEEDS, and the robot is then within 0.10 m and 0.15 rad of the goal"""
    require_arrival(run.goal("walk"))


@check(points=1, on=WALK, needs=arrives, see="06_walk_to_a_pose#touch-why")
def ends_with_a_zero_twist(run: Transcript) -> None:
    """The last Twist before it SUCCEEDS is zero, and no other follows"""
    require_final_zero(run, run.goal("walk"))


@check(points=1, on=WALK, needs=arrives, see="06_walk_to_a_pose#touch-why")
def stands_when_it_succeeds(run: Transcript) -> None:
    """When it SUCCEEDS the robot stands still, and stays so"""
    require_standing_at_success(run.goal("walk"))


@check(points=1, on=WALK, needs=arrives, see="06_walk_to_a_pose#settle-why")
def fills_the_result(run: Transcript) -> None:
    """The result holds the final pose, the steps and error_code NONE"""
    require_filled_result(run.goal("walk"))


@check(points=1, on=WALK, needs=walks_to_the_goal, see="06_walk_to_a_pose#conventions")
def feedback_keeps_its_rate(run: Transcript) -> None:
    """Feedback comes at 5 Hz without a gap over 1 s"""
    require_good_feedback_rate(run.goal("walk"))


@check(points=1, on=WALK, needs=feedback_keeps_its_rate, see="06_walk_to_a_pose#settle-intro")
def feedback_is_true(run: Transcript) -> None:
    """Pose, distance and steps in the feedback are the robot's"""
    require_true_feedback(run.goal("walk"))


feedback_ends_with_the_goal = standard.feedback_ends_with_the_goal(
    "walk", points=1, on=WALK, needs=[arrives, feedback_keeps_its_rate], see="06_walk_to_a_pose#settle-intro"
)


@check(points=1, on=FALL, needs=walks_to_the_goal, see="06_walk_to_a_pose#fall-why")
def aborts_when_the_robot_falls(run: Transcript) -> None:
    """When the robot falls the goal is ABORTED with FELL"""
    require_aborted_by_a_fall(run.goal("walk"))


ends_cleanly = standard.ends_cleanly(
    points=1, on=INTERRUPT, needs=server_appears, see="01_robot_and_graph#listen-intro"
)
