"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario, check, expect
from autograder.authoring.feedback import require_good_feedback_rate
from autograder.authoring.goal import ABORTED, SUCCEEDED
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.aborts import require_aborted_by_a_fall, require_preempted
from autograder.authoring.walking.reports import require_error_code, require_true_places
from autograder.authoring.walking.truth import (
    require_accepted,
    require_arrival,
    require_stopped,
    require_walking,
)

from .odometer import require_measured_path
from .phases import require_facing, require_named_phases
from .progress import require_half_done_half_way, require_rising_progress
from .recoveries import require_detour_counted, require_led_astray, require_no_detour
from .times import require_good_estimate, require_true_navigation_time

GO = Scenario("navigate", {"x": -1.4, "y": 1.4, "yaw": -2.6})
STAY = Scenario("stay")
IMPOSSIBLE = Scenario("ask_for_the_impossible", {"frame": "map", "tolerances": [0.03, -0.2]}, robot=RESTING)
UNPOWERED = Scenario("ask_without_power")
ASTRAY = Scenario("lead_astray", {"x": 1.8, "y": 0.0, "back": 4.0, "turn": 1})
HELD = Scenario("hold", {"x": 1.0, "after": 0.55})
MID_STRIDE = Scenario("cancel", {"x": 2.0, "y": 0.0, "delays": [1.5]})
PREEMPT = Scenario("preempt", {"x": 1.2, "y": 0.4, "yaw": 0.5, "after": 2.0})
FALL = Scenario("fall", {"impulse": [0.0, 60.0, 0.0]})
INTERRUPT = Scenario("interrupt", robot=RESTING)

KNOWN = 0.6  # s for a change of the robot to be known to the node
AT_ONCE = 4.0  # s
STAYED = 0.10  # m the pelvis may move while the robot only stands
EARLY, LATE = 1.5, 4.0  # s a TIMEOUT may come too early, and too late: the robot has to stand first
_ODOM_TELLS = "Count legs of the way in odom: the robot may not obey what you publish on cmd_vel."

server_appears = standard.server_appears(
    "the action navigate_to_pose", points=1, on=INTERRUPT, see="06_walk_to_a_pose#small-intro", clauses=[21]
)


@check(points=1, on=GO, needs=server_appears, see="06_walk_to_a_pose#reject-task", clauses=[1])
def accepts_a_goal(run: Transcript) -> None:
    """It accepts a pose in frame odom"""
    require_accepted(run.goal("go"))


@check(points=2, on=GO, needs=accepts_a_goal, see="06_walk_to_a_pose#settle-why", clauses=[2, 4, 20])
def arrives(run: Transcript) -> None:
    """It SUCCEEDS, and the robot is then within 0.10 m and 0.15 rad of the goal (tolerance 0)"""
    require_arrival(run.goal("go"))
    require_error_code(run.goal("go"), "NONE", because="the robot has arrived")


@check(points=1, on=GO, needs=arrives, see="08_navigation#why", clauses=[3])
def faces_its_way(run: Transcript) -> None:
    """It turns toward the goal, then walks straight ahead"""
    require_facing(run.goal("go"))


@check(points=1, on=GO, needs=accepts_a_goal, see="06_walk_to_a_pose#settle-intro", clauses=[6])
def feedback_keeps_its_rate(run: Transcript) -> None:
    """Feedback comes at 5 Hz without a gap over 1 s"""
    require_good_feedback_rate(run.goal("go"))


@check(points=1, on=GO, needs=feedback_keeps_its_rate, see="08_navigation#action-intro", clauses=[7])
def feedback_is_true(run: Transcript) -> None:
    """Pose and distance in the feedback are the robot's"""
    require_true_places(run.goal("go"))


@check(
    points=1,
    on=GO,
    needs=[arrives, faces_its_way, feedback_keeps_its_rate],
    see="08_navigation#loops-intro",
    clauses=[8],
)
def names_its_phases(run: Transcript) -> None:
    """Status names the phase: turn, walk, turn to the heading"""
    require_named_phases(run.goal("go"))


@check(
    points=1, on=GO, needs=[arrives, feedback_keeps_its_rate], see="08_navigation#conventions", clauses=[9]
)
def tells_its_time(run: Transcript) -> None:
    """navigation_time is the time since acceptance"""
    require_true_navigation_time(run.goal("go"))


@check(points=1, on=GO, needs=[arrives, feedback_keeps_its_rate], see="08_navigation#eta-why", clauses=[10])
def estimates_the_time(run: Transcript) -> None:
    """estimated_time_remaining is positive under way, and right within a factor of 2 half way"""
    require_good_estimate(run.goal("go"))


@check(points=1, on=GO, needs=[arrives, feedback_keeps_its_rate], see="08_navigation#zero-why", clauses=[11])
def progress_rises_to_100(run: Transcript) -> None:
    """progress_percentage rises, is about half where half of the distance is left, and ends at 100"""
    require_rising_progress(run.goal("go"))
    require_half_done_half_way(run.goal("go"))


@check(points=2, on=GO, needs=arrives, see="08_navigation#sway-why", clauses=[12, 13])
def measures_its_path(run: Transcript) -> None:
    """distance_traveled is the path walked, within 15 %, though the pelvis sways"""
    require_measured_path(run.goal("go"), run.goal("go").require_result(SUCCEEDED))


@check(points=1, on=GO, needs=feedback_keeps_its_rate, see="08_navigation#recovery-why", clauses=[14, 15])
def counts_no_detour_without_one(run: Transcript) -> None:
    """number_of_recoveries stays 0 while nothing disturbs the robot"""
    require_accepted(run.goal("go"))
    require_no_detour(run.goal("go"))


feedback_ends_with_the_goal = standard.feedback_ends_with_the_goal(
    "go", points=1, on=GO, needs=[arrives, feedback_keeps_its_rate], clauses=[6]
)


@check(points=1, on=STAY, needs=arrives, see="08_navigation#zero-why", clauses=[5, 12])
def succeeds_at_once_where_it_stands(run: Transcript) -> None:
    """A goal equal to the present pose SUCCEEDS at once, with 100 % and without a walk"""
    goal = run.goal("stay")
    end = require_accepted(goal).require_result(SUCCEEDED)
    took = end.t - goal.accepted_at
    expect(
        took <= AT_ONCE,
        expected=f"success within {AT_ONCE:.0f} s: the robot is there already",
        observed=f"it came after {took:.1f} s",
        help="Look whether the robot is there before you look where to turn: at distance 0 the bearing means nothing.",
        at=end.t,
    )
    require_arrival(goal)
    require_rising_progress(goal)
    distance = float(end.result.distance_traveled)
    expect(
        0.0 <= distance <= STAYED,
        expected="distance_traveled 0 m: the robot did not walk",
        observed=f"{distance:.2f} m",
        help="Begin the path of each goal at 0, where the robot is when it is accepted.",
        at=end.t,
    )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_goal, see="08_navigation#map-why", clauses=[1])
def rejects_a_wrong_pose(run: Transcript) -> None:
    """It rejects a pose in frame map, and one that holds NaN"""
    run.goal("wrong frame").require_rejected(
        because="the robot knows no frame 'map'",
        help="Compare goal_request.pose.header.frame_id with 'odom' in goal_callback and return GoalResponse.REJECT.",
    )
    for name in ("NaN position", "NaN orientation"):
        run.goal(name).require_rejected(
            because=f"{name} cannot be walked to",
            help="Test every number of position and orientation with math.isfinite() in goal_callback: NaN "
            "compares false with everything.",
        )


@check(points=1, on=IMPOSSIBLE, needs=accepts_a_goal, see="06_walk_to_a_pose#reject-task", clauses=[2])
def rejects_a_wrong_tolerance(run: Transcript) -> None:
    """It rejects a tolerance that is NaN, or below 0.05 m and not 0"""
    tolerances = [*run.params["tolerances"], float("nan")]
    for number, tolerance in enumerate(tolerances, start=1):
        run.goal(f"tolerance {number}").require_rejected(
            because=f"a tolerance of {tolerance:g} m cannot be kept",
            help="NaN < 0.05 is false: ask math.isfinite() as well."
            if tolerance != tolerance
            else "0 asks for the default of 0.10 m; anything else below 0.05 m is rejected, negative numbers too.",
        )


@check(points=1, on=UNPOWERED, needs=accepts_a_goal, see="06_walk_to_a_pose#reject-task", clauses=[1])
def rejects_without_power(run: Transcript) -> None:
    """It rejects a goal while the motors are off"""
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
    run.goal("unpowered").require_rejected(
        because="robot_state.motors_enabled is false",
        help="Subscribe to robot_state and reject in goal_callback when motors_enabled is false in the last message.",
    )


@check(points=2, on=ASTRAY, needs=arrives, see="08_navigation#loops-why", clauses=[14, 15])
def gets_back_on_its_way(run: Transcript) -> None:
    """Led back and turned by a remote control, it finds its way again, and arrives"""
    require_led_astray(run.goal("go"))
    require_arrival(run.goal("go"))


@check(
    points=1,
    on=ASTRAY,
    needs=[gets_back_on_its_way, feedback_keeps_its_rate],
    see="08_navigation#recovery-why",
    clauses=[14, 15],
)
def counts_the_recovery(run: Transcript) -> None:
    """number_of_recoveries counts it, once"""
    require_detour_counted(run.goal("go"))


@check(
    points=1,
    on=ASTRAY,
    needs=[gets_back_on_its_way, progress_rises_to_100],
    see="08_navigation#zero-fix-why",
    clauses=[11],
)
def progress_never_falls(run: Transcript) -> None:
    """progress_percentage does not fall when the robot is led back"""
    require_led_astray(run.goal("go"))
    require_rising_progress(run.goal("go"))


@check(
    points=1,
    on=ASTRAY,
    needs=[gets_back_on_its_way, measures_its_path],
    see="08_navigation#odometer-why",
    clauses=[12],
)
def measures_a_detour(run: Transcript) -> None:
    """distance_traveled includes the way back and forth"""
    require_led_astray(run.goal("go"))
    require_measured_path(run.goal("go"), run.goal("go").require_result(SUCCEEDED), reversals=2)


@check(points=2, on=HELD, needs=arrives, see="08_navigation#late-why", clauses=[16])
def gives_up_in_time(run: Transcript) -> None:
    """Held up, it ends ABORTED with TIMEOUT after 30 s and 15 s per metre"""
    goal = require_accepted(run.goal("held"))
    taken = run.told("take_over", velocity=[0.0, 0.0, 0.0])
    limit = 30.0 + 15.0 * run.params["x"]
    end = goal.require_result(
        ABORTED,
        help=f"The robot was held {taken.t - goal.accepted_at:.0f} s after acceptance. Compare the time since "
        "acceptance with the limit in every round.",
    )
    require_error_code(goal, "TIMEOUT", because="the time is over")
    took = end.t - goal.accepted_at
    expect(
        limit - EARLY <= took <= limit + LATE,
        expected=f"TIMEOUT {limit:.0f} s after acceptance, 30 s and 15 s for the metre that was to go then",
        observed=f"it came after {took:.1f} s",
        help="Compute the limit once, from the distance at acceptance, and count from acceptance.",
        at=end.t,
    )


@check(points=1, on=HELD, needs=gives_up_in_time, see="06_walk_to_a_pose#touch-why", clauses=[16])
def stands_still_after_the_limit(run: Transcript) -> None:
    """After TIMEOUT the robot stands still, also when it is let go"""
    require_accepted(run.goal("held"))
    require_stopped(run, run.told("take_over", velocity=None).t, event="being let go")


@check(
    points=1,
    on=HELD,
    needs=[gives_up_in_time, measures_its_path],
    see="08_navigation#odometer-why",
    clauses=[12],
)
def measures_what_was_walked(run: Transcript) -> None:
    """distance_traveled is what was walked, not what was commanded"""
    require_measured_path(run.goal("held"), run.goal("held").require_result(ABORTED), too_much=_ODOM_TELLS)


@check(points=2, on=MID_STRIDE, needs=accepts_a_goal, see="07_cancel_and_preempt#fix-intro", clauses=[17])
def cancels_in_mid_stride(run: Transcript) -> None:
    """A cancel while the robot walks ends CANCELED, and within 2 s the robot stands still and upright"""
    goal = run.goal("after 1.5 s")
    request = goal.require_canceled()
    require_error_code(goal, "NONE", because="the goal was canceled, which is no error")
    require_walking(run, request.t)
    require_stopped(run, request.t)


@check(points=2, on=PREEMPT, needs=arrives, see="07_cancel_and_preempt#preempt-why", clauses=[18])
def new_goal_preempts_the_old(run: Transcript) -> None:
    """A new goal aborts the old one with PREEMPTED and is walked to"""
    require_preempted(run.goal("old"), run.goal("new"))


@check(points=1, on=FALL, needs=accepts_a_goal, see="07_cancel_and_preempt#fall-why", clauses=[19])
def aborts_when_the_robot_falls(run: Transcript) -> None:
    """When the robot falls the goal is ABORTED with FELL"""
    require_aborted_by_a_fall(run.goal("walk"))


ends_cleanly = standard.ends_cleanly(
    points=1, on=INTERRUPT, needs=server_appears, see="07_cancel_and_preempt#conventions", clauses=[21]
)
