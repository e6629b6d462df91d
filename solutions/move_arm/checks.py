"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import standard
from autograder.authoring.arms.motion import (
    require_arrival,
    require_moving,
    require_points_passed,
    require_stayed_short,
    require_stopped,
)
from autograder.authoring.arms.reports import require_filled_result, require_named, require_true_feedback
from autograder.authoring.arms.truth import require_accepted
from autograder.authoring.checks import RESTING, Scenario, check
from autograder.authoring.feedback import require_good_feedback_rate
from autograder.authoring.transcript import Transcript

from .judging import (
    require_both,
    require_goal_violation,
    require_last_trajectory_empty,
    require_path_violation,
    require_preempted,
)

MOVE = Scenario(
    "move",
    {
        "arm": "l",
        "joints": ["l_elbow", "l_shoulder_pitch", "l_wrist_yaw"],
        "points": [[1.5, [-0.9, -0.2, 0.2]], [2.8, [-1.2, -0.3, 0.4]], [4.1, [-0.9, -0.2, 0.2]]],
    },
)
IMPOSSIBLE = Scenario("ask_for_the_impossible", robot=RESTING)
BLOCK = Scenario("block", {"arm": "l"})
HOLD_SHORT = Scenario("hold_short", {"goal_tolerance": 0.0})
CANCEL = Scenario("cancel")
PREEMPT = Scenario("preempt")
BOTH = Scenario("move_both")
INTERRUPT = Scenario("interrupt", robot=RESTING)

LOOK = "07_cancel_and_preempt#conventions"

server_appears = standard.server_appears(
    "the action move_arm", points=1, on=INTERRUPT, see="07_cancel_and_preempt#fix-file", clauses=[17]
)


@check(points=1, on=MOVE, needs=server_appears, see="09_arms#conventions", clauses=[1])
def accepts_a_trajectory(run: Transcript) -> None:
    """It accepts a trajectory of an arm's joints within their ranges"""
    require_accepted(run.goal("move"))


@check(points=2, on=MOVE, needs=accepts_a_trajectory, see="09_arms#clock-why", clauses=[7])
def arrives(run: Transcript) -> None:
    """It SUCCEEDS, and every joint is then within 0.05 rad of the last point"""
    require_arrival(run.goal("move"))


@check(points=1, on=MOVE, needs=accepts_a_trajectory, see="09_arms#velocities-why", clauses=[6])
def passes_every_point(run: Transcript) -> None:
    """The arm passes every point of the trajectory at about its time"""
    require_points_passed(run.goal("move"))


@check(points=1, on=MOVE, needs=arrives, see="07_cancel_and_preempt#m13-why", clauses=[8])
def fills_the_result(run: Transcript) -> None:
    """The result of a goal that succeeded holds error_code NONE and an empty error_msg"""
    require_filled_result(run.goal("move"))


@check(points=1, on=MOVE, needs=accepts_a_trajectory, see=LOOK, clauses=[13])
def feedback_keeps_its_rate(run: Transcript) -> None:
    """Feedback comes at 10 Hz without a gap over 1 s"""
    require_good_feedback_rate(run.goal("move"), wanted=10.0, lowest=6.0, highest=15.0)


@check(points=1, on=MOVE, needs=accepts_a_trajectory, see="09_arms#bend-why", clauses=[13])
def feedback_is_true(run: Transcript) -> None:
    """waypoint, max_error and progress_percentage in the feedback are the arm's"""
    require_true_feedback(run.goal("move"))


feedback_ends_with_the_goal = standard.feedback_ends_with_the_goal(
    "move", points=1, on=MOVE, needs=arrives, clauses=[13]
)


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_trajectory, see="09_arms#silent-why", clauses=[2])
def rejects_foreign_joints(run: Transcript) -> None:
    """It rejects an arm that is neither l nor r, and joints that are not this arm's"""
    run.goal("no arm").require_rejected(
        because="the robot has the arms l and r, and no x", help="Look at goal_request.arm in goal_callback."
    )
    for name, joint in (
        ("unknown joint", "l_elbow_2"),
        ("other arm's joint", "r_elbow"),
        ("leg's joint", "l_knee"),
    ):
        run.goal(name).require_rejected(
            because=f"{joint} is not a joint of the arm l",
            help="The arm l has the joints in joint_limits.names that begin with l_. A leg's joint begins so, too, but "
            "is not in that list.",
        )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_trajectory, see="09_arms#conventions", clauses=[3])
def rejects_lists_that_do_not_fit(run: Transcript) -> None:
    """It rejects a trajectory without a point, and points with too few or too many positions"""
    run.goal("no point").require_rejected(
        because="there is nowhere to go", help="An empty list is false: `if not trajectory.points`."
    )
    for name in ("too few positions", "too many positions"):
        run.goal(name).require_rejected(
            because=f"a point has {name}",
            help="Compare len(point.positions) with len(trajectory.joint_names), for every point.",
        )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_trajectory, see="09_arms#conventions", clauses=[4])
def rejects_times_that_do_not_rise(run: Transcript) -> None:
    """It rejects a trajectory whose times do not rise from point to point"""
    for name in ("equal times", "falling times"):
        run.goal(name).require_rejected(
            because=f"{name} of two points",
            help="time_from_start.sec + time_from_start.nanosec * 1e-9 must be greater than that of the point before.",
        )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_trajectory, see="09_arms#conventions", clauses=[5])
def rejects_nan(run: Transcript) -> None:
    """It rejects a trajectory that holds NaN or an infinite position"""
    for name in ("NaN first", "NaN last", "infinite"):
        run.goal(name).require_rejected(
            because="a position is not a finite number",
            help="Test every position of every point with math.isfinite(): NaN compares false with everything, so it "
            "is neither below nor above a limit.",
        )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_trajectory, see="09_arms#silent-why", clauses=[5])
def rejects_out_of_range(run: Transcript) -> None:
    """It rejects a position outside the joint's range"""
    for name, position in (("above the range", 0.2), ("below the range", -2.6)):
        run.goal(name).require_rejected(
            because=f"l_elbow cannot get to {position} rad",
            help="Compare each position of every point with lower and upper of that joint in joint_limits.",
        )


@check(points=2, on=BLOCK, needs=arrives, see="09_arms#bend-why", clauses=[10])
def aborts_when_the_arm_is_blocked(run: Transcript) -> None:
    """An arm that is more than 0.5 rad off its trajectory ends the goal with PATH_TOLERANCE_VIOLATED"""
    require_path_violation(run.goal("move"), "l_elbow")


@check(points=1, on=BLOCK, needs=aborts_when_the_arm_is_blocked, see="09_arms#bend-why", clauses=[11])
def names_the_blocked_joint(run: Transcript) -> None:
    """error_msg names the joint that was blocked, and no other"""
    require_named(run.goal("move"), "l_elbow", ["l_shoulder_pitch", "l_wrist_pitch"])


@check(points=1, on=BLOCK, needs=aborts_when_the_arm_is_blocked, see="09_arms#release-why", clauses=[10])
def holds_when_the_arm_was_blocked(run: Transcript) -> None:
    """After that the arm does not go on, also when nothing blocks it any more"""
    since = run.told("release_joint", joint="l_elbow").t
    require_stayed_short(run.goal("move"), "l_elbow", by=0.25, since=since, until=since + 2.0)


@check(points=2, on=HOLD_SHORT, needs=arrives, see="09_arms#bend-why", clauses=[9])
def aborts_when_the_end_is_missed(run: Transcript) -> None:
    """A joint that is not at its end 1 s after it is due ends the goal with GOAL_TOLERANCE_VIOLATED"""
    require_goal_violation(run.goal("move"), "l_elbow")


@check(points=1, on=HOLD_SHORT, needs=aborts_when_the_end_is_missed, see="09_arms#bend-why", clauses=[11])
def names_the_worst_joint(run: Transcript) -> None:
    """error_msg names the joint that is farthest from its end, and no other"""
    require_named(run.goal("move"), "l_elbow", ["l_shoulder_pitch"])


@check(points=2, on=CANCEL, needs=accepts_a_trajectory, see="07_cancel_and_preempt#m1-why", clauses=[14])
def cancels(run: Transcript) -> None:
    """A cancel while the arm moves is agreed to and ends CANCELED"""
    request = run.goal("move").require_canceled()
    require_moving(run, "l_elbow", request.t)


@check(points=2, on=CANCEL, needs=cancels, see="09_arms#brake-why", clauses=[14])
def stops_when_canceled(run: Transcript) -> None:
    """Within 1 s of the cancel the arm stands still"""
    request = run.goal("move").requests_to_cancel[-1].sent
    require_moving(run, "l_elbow", request.t)
    require_stopped(run, ["l_elbow", "l_wrist_pitch"], request.t)


@check(points=1, on=CANCEL, needs=stops_when_canceled, see="09_arms#brake-why", clauses=[14])
def holds_by_an_empty_trajectory(run: Transcript) -> None:
    """What stops the arm is an empty trajectory"""
    request = run.goal("move").requests_to_cancel[-1].sent
    require_last_trajectory_empty(run, request.t, run.end)


@check(points=2, on=PREEMPT, needs=arrives, see="07_cancel_and_preempt#preempt-why", clauses=[15])
def new_goal_preempts_the_old(run: Transcript) -> None:
    """A new goal for the same arm aborts the old one with PREEMPTED and is carried out"""
    require_preempted(run.goal("old"), run.goal("new"), "l_elbow")


@check(points=2, on=BOTH, needs=arrives, see="09_arms#replace-why", clauses=[16])
def moves_both_arms(run: Transcript) -> None:
    """Goals for both arms are carried out at the same time"""
    require_both(run.goal("left"), run.goal("right"), "l_elbow")


ends_cleanly = standard.ends_cleanly(points=1, on=INTERRUPT, needs=server_appears, see=LOOK, clauses=[17])
