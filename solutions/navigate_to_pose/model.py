"""What must hold for every goal of navigate_to_pose, and for the robot without a goal, clause by clause."""

from __future__ import annotations

import math
import re
from collections import Counter

from autograder.authoring import ABORTED, SUCCEEDED, Goal, ev, expect, goals, not_shown, obligation, whole_run
from autograder.authoring.walking import life, objections
from autograder.authoring.walking.objections import accepting, objection, rejects
from autograder.authoring.walking.obligations import cancels, ends, reporting, walks
from autograder.authoring.walking.path import STRIDE, length_walked, length_without_sway, walking_speed
from autograder.authoring.walking.planar import error
from autograder.authoring.walking.reports import require_error_code
from autograder.authoring.walking.truth import require_arrival, require_stopped
from ros_runtime.message_constants import GoalStatus, name_of

from .legs import Leg, feedback_half_way, feedback_of, led_astray, legs, off_the_way, operated, under_way

MIN_TOLERANCE = 0.05  # m
HERE = 0.05  # m or rad; a goal this near equals the present pose
HERE_TIMEOUT = 4.0  # s
MAX_SWAY = 0.10  # m, by which the pelvis may move while the robot stands
TIMEOUT_EARLY, TIMEOUT_LATE = (
    1.5,
    4.0,
)  # s, by which a TIMEOUT may come early or late: the robot has to stop first
FACING = 0.6  # rad between heading and goal while it walks
IN_PLACE_SPEED = 0.10  # m/s of the whole body
# As shares of the greatest speed, and of the greatest turn rate in place, on a leg.
WALK_SHARE, STAND_SHARE, TURN_SHARE = 0.7, 0.4, 0.5
TIME_SLACK = 1.0  # s, by which a time in the feedback may be wrong because of its period and delivery
ESTIMATE_FACTOR = 2.0  # by which an estimate may be wrong
HALF_WAY = 25.0, 75.0  # percent
COMPLETE = 99.5  # percent
LOST_AT_A_TURN = 0.2  # m; where the robot turns back, up to half a leg before and after it may not be counted
GREATEST_FILTER = 0.2  # m; a server may add a distance only when it is this long
PATH_SHARE, MIN_PATH_SLACK = 0.15, 0.25  # by which distance_traveled may be wrong: share of the path; m
MAX_DETOURS = 3  # for one detour; a server may count the turn and the walk back separately
_NUMBER = re.compile(r"[-+]?\d+([.,]\d+)?")
_COUNTS_SWAY = (
    "The pelvis sways 3 cm to each side with every step, also while the robot turns in place. Add a distance only when "
    "odom is at least 0.15 m away from the last position that you added."
)
_MEASURE_IN_ODOM = "Add up distances in odom: the robot may not follow what you publish on cmd_vel."
_OF_EACH_GOAL = "Start the sum at 0 for every goal: keep it in execute, not in the node."


# -- which goals it accepts -------------------------------------------------------------------------------------------


@objection(
    "0 means the default of 0.10 m. Reject every other tolerance below 0.05 m, also negative numbers and NaN: as "
    "NaN < 0.05 is false, use math.isfinite() as well."
)
def _tolerances(goal: Goal) -> str | None:
    """It rejects a tolerance that is NaN, or below 0.05 m but not 0."""
    tolerance = goal.request.tolerance
    if abs(tolerance - MIN_TOLERANCE) < 1e-6 or tolerance == math.inf:
        return None  # rounded to a float32, 0.05 may be a little smaller; infinity is left open
    is_valid = tolerance == 0.0 or tolerance >= MIN_TOLERANCE
    return "" if is_valid else f"a tolerance of {tolerance:g} m is not allowed"


accepts = obligation(1, 2, 18, of=goals, see="06_walk_to_a_pose#reject-task")(
    accepting(
        objections.frames, objections.nan, objections.UNSAID_ROTATION, _tolerances, objections.without_power
    )
)
rejects_frames = rejects(1, objections.frames)
rejects_nan = rejects(1, objections.nan)
rejects_without_power = rejects(1, objections.without_power)
rejects_tolerances = rejects(2, _tolerances)


# -- how goals end ----------------------------------------------------------------------------------------------------

goes_on = obligation(1, of=goals)(ends.goes_on)
succeeds = obligation(2, 4, of=goals, see="06_walk_to_a_pose#settle-why")(ends.succeeds)
stands_at_success = obligation(4, of=goals)(walks.stands_at_success)
status_in_order = obligation(4, of=goals)(ends.status_in_order)
grants_cancels = obligation(17, of=goals, see="07_cancel_and_preempt#fix-intro")(cancels.grants_cancels)
walks_until_canceled = obligation(17, of=goals)(cancels.walks_until_canceled)
stops_when_canceled = obligation(17, of=goals)(cancels.stops_when_canceled)
stands_without_a_goal = obligation(4, 16, 17, of=whole_run)(walks.stands_without_a_goal)
gives_way = obligation(18, of=goals)(ends.gives_way)
tells_a_fall = obligation(19, of=goals, see="07_cancel_and_preempt#fall-why")(ends.tells_a_fall)
names_no_error = obligation(20, of=goals)(reporting.names_no_error)
says_why_it_aborted = obligation(20, of=goals)(reporting.says_why_it_aborted)


@obligation(5, of=goals, see="08_navigation#zero-why")
def succeeds_where_it_stands(goal: Goal) -> str | None:
    """A goal equal to the present pose SUCCEEDS within 4 s, and the robot does not walk"""
    distance, turn = error(goal.run.robot_at(goal.sent.t), goal)
    is_there = distance <= HERE and turn <= HERE and life.began_at_rest(goal)
    if not is_there or not life.is_undisturbed(goal) or life.was_not_awaited(goal):
        return None
    require_arrival(goal)
    end = goal.require_result(SUCCEEDED)
    took = end.t - goal.accepted_at
    expect(
        took <= HERE_TIMEOUT,
        expected=f"SUCCEEDED within {HERE_TIMEOUT:.0f} s, as the robot is already there",
        observed=f"SUCCEEDED after {took:.1f} s",
        help="Check whether the robot has arrived before you compute the bearing: at distance 0 it is meaningless.",
        at=end.t,
    )
    steps = goal.run.robot_at(end.t).steps - goal.run.robot_at(goal.sent.t).steps
    expect(
        steps == 0,
        expected="SUCCEEDED without a step, as the robot is already there",
        observed=f"{steps} steps",
        help="Publish only zero velocity if distance and turn are within the tolerance from the start.",
        at=end.t,
    )
    distance = float(end.result.distance_traveled)
    expect(
        0.0 <= distance <= MAX_SWAY,
        expected="distance_traveled 0 m, as the robot did not walk",
        observed=f"{distance:.2f} m",
        help="Start distance_traveled at 0 for each goal, at the robot's position when the goal is accepted.",
        at=end.t,
    )
    return life.phase(goal)


@obligation(16, of=goals, see="08_navigation#late-why")
def gives_up_in_time(goal: Goal) -> str | None:
    """A goal that is not reached within 30 s plus 15 s per metre is ABORTED with TIMEOUT then, not earlier"""
    if not life.accepted(goal) or life.interrupted(goal):
        return None
    start, result = goal.accepted_at, goal.result
    limit = 30.0 + 15.0 * error(goal.run.robot_at(start), goal)[0]
    given_up = goal.run.given_up("result", goal.name)
    lasted = (result.t if result else given_up.t if given_up else goal.run.end) - start
    slack = TIMEOUT_LATE if goal.status == SUCCEEDED else -TIMEOUT_EARLY
    if not _timed_out(goal) and lasted < limit + slack:
        return None
    end = goal.require_result(
        ABORTED,
        help="Compare the time since acceptance with the limit in every round, also while the robot does not move.",
    )
    require_error_code(goal, "TIMEOUT", because="the time limit was reached")
    expect(
        limit - TIMEOUT_EARLY <= lasted <= limit + TIMEOUT_LATE,
        expected=f"TIMEOUT {limit:.0f} s after acceptance: 30 s plus 15 s per metre of the distance at acceptance",
        observed=f"TIMEOUT after {lasted:.1f} s",
        help="Compute the limit once, from the distance at acceptance, and count the time from acceptance.",
        at=end.t,
    )
    return "held" if operated(goal, "hold") else "under way"


@obligation(16, of=goals, see="06_walk_to_a_pose#touch-why")
def stands_after_the_limit(goal: Goal) -> str | None:
    """After TIMEOUT the robot stands still, also when it is no longer held"""
    if not _timed_out(goal) or not operated(goal, "hold"):
        return None
    require_stopped(goal.run, goal.run.last_command("take_over", velocity=None).t, event="its release")
    return "released"


def _timed_out(goal: Goal) -> bool:
    result = goal.result
    return bool(result and result.status == ABORTED and result.result.error_code == result.result.TIMEOUT)


# -- the way, and the feedback during it ------------------------------------------------------------------------------

feedback_at_5_hz = obligation(6, of=goals, see="06_walk_to_a_pose#settle-intro")(reporting.feedback_at_5_hz)
feedback_ends_with_the_goal = obligation(6, of=goals, see="07_cancel_and_preempt#m13-why")(
    reporting.feedback_ends_with_the_goal
)
feedback_is_true = obligation(7, of=goals, see="08_navigation#action-intro")(reporting.feedback_is_true)


@obligation(3, of=legs, see="08_navigation#why")
def faces_its_way(leg: Leg) -> str:
    """It turns toward the goal, then walks straight ahead: half way it faces the goal"""
    run = leg.goal.run
    for robot in run.robot_between(leg.half - 1.0, leg.half + 0.5):
        if walking_speed(run, robot.t) < IN_PLACE_SPEED:
            continue
        off = off_the_way(robot, leg.goal)
        expect(
            off <= FACING,
            expected="the robot to turn toward the goal first, then to walk straight ahead",
            observed=f"it walked with its heading {off:.1f} rad off the goal",
            help="While the goal is farther than 0.3 m, publish only angular.z until math.atan2(dy, dx) minus the "
            "heading is small; only then publish linear.x.",
            at=robot.t,
        )
    return life.phase(leg.goal)


@obligation(8, of=legs, see="08_navigation#loops-intro")
def names_its_phases(leg: Leg) -> str:
    """feedback.status differs between the walk and the turns before and after it"""
    goal = leg.goal
    moves = [
        (robot, walking_speed(goal.run, robot.t))
        for robot in goal.run.robot_between(leg.start, leg.end)[::10]
    ]
    fastest = max(speed for _, speed in moves)
    in_place = min(IN_PLACE_SPEED, STAND_SHARE * fastest)
    turn_rate = TURN_SHARE * max(
        (abs(robot.turn_rate) for robot, speed in moves if speed < in_place), default=0.0
    )

    def turns(robot: ev.RobotTruth, speed: float) -> bool:
        return speed < in_place and abs(robot.turn_rate) > turn_rate

    turning = _statuses(goal, leg.start, leg.half, turns)
    walking = _statuses(goal, leg.start, leg.end, lambda robot, speed: speed > WALK_SHARE * fastest)
    aligning = _statuses(goal, leg.half, leg.end, turns)
    for what, statuses in (
        ("the robot turns toward the goal", turning),
        ("the robot walks", walking),
        ("the robot turns to the goal's heading", aligning),
    ):
        if not statuses:
            raise not_shown(goal.run, f"feedback comes while {what}")
        expect(
            all(status.strip() for status in statuses),
            expected=f"feedback.status in words while {what}",
            observed="an empty status",
            help="Keep the phase in a variable, change it when the robot's motion changes, and copy it to "
            "feedback.status.",
        )
    names = [statuses.most_common(1)[0][0] for statuses in (turning, walking, aligning)]
    expect(
        names[1] not in (names[0], names[2]),
        expected="a feedback.status during the walk that differs from those during the turns before and after it",
        observed=f"{names[0]!r} during the first turn, {names[1]!r} during the walk, {names[2]!r} during the last turn",
        help="Set the phase when the loop starts to turn, to walk or to align, and publish it in feedback.status.",
        at=leg.half,
    )
    return life.phase(goal)


def _statuses(goal: Goal, start: float, end: float, during) -> Counter[str]:
    """Count the values of feedback.status, without numbers, at times when `during` holds for robot and speed."""
    run = goal.run
    return Counter(
        _NUMBER.sub("", feedback.feedback.status)
        for feedback in goal.feedback
        if start < feedback.t < end and during(run.robot_at(feedback.t), walking_speed(run, feedback.t))
    )


@obligation(9, of=goals, see="08_navigation#conventions")
def tells_its_time(goal: Goal) -> str | None:
    """navigation_time is the time since this goal was accepted"""
    if not life.accepted(goal) or life.interrupted(goal):
        return None
    start, reports = goal.accepted_at, feedback_of(goal)
    if not reports or reports[-1].t - start < 2 * TIME_SLACK:
        return None
    for feedback in reports:
        claimed, true = reporting.seconds(feedback.feedback.navigation_time), feedback.t - start
        expect(
            abs(claimed - true) <= TIME_SLACK,
            expected=f"navigation_time about {true:.1f} s, the time since this goal was accepted",
            observed=f"{claimed:.1f} s",
            help="Store the time when this goal is accepted, and subtract it from the current time. Do not use the "
            "start of the node or of a phase."
            if claimed
            else "Set feedback.navigation_time to the time since the goal was accepted.",
            at=feedback.t,
        )
    return life.phase(goal)


@obligation(10, of=legs, see="08_navigation#eta-why")
def estimates_the_time(leg: Leg) -> str:
    """estimated_time_remaining is positive under way, and half way it is right within a factor of 2"""
    for feedback in under_way(leg.goal):
        estimate = reporting.seconds(feedback.feedback.estimated_time_remaining)
        expect(
            estimate > 0,
            expected="estimated_time_remaining above 0 while the robot is under way",
            observed=f"{estimate:.2f} s",
            help="Set it in every feedback, with rclpy.duration.Duration(seconds=…).to_msg(). With sec alone it is 0 "
            "in the last second. Do not divide by a speed of 0.",
            at=feedback.t,
        )
    estimate = reporting.seconds(feedback_half_way(leg).feedback.estimated_time_remaining)
    left = leg.end - leg.half
    expect(
        left / ESTIMATE_FACTOR <= estimate <= left * ESTIMATE_FACTOR,
        expected=f"half way estimated_time_remaining from {left / ESTIMATE_FACTOR:.1f} to "
        f"{left * ESTIMATE_FACTOR:.1f} s, as the robot then took {left:.1f} s more",
        observed=f"{estimate:.1f} s",
        help="Divide the remaining distance by the measured walking speed, and add the time for the last turn and for "
        "coming to rest.",
        at=leg.half,
    )
    return life.phase(leg.goal)


@obligation(5, 11, of=goals, see="08_navigation#zero-why")
def progress_rises(goal: Goal) -> str | None:
    """progress_percentage is from 0 to 100, never falls, and is 100 in the last feedback of a goal that SUCCEEDED"""
    if (
        not life.accepted(goal)
        or life.interrupted(goal)
        or not (feedback_of(goal) or goal.status == SUCCEEDED)
    ):
        return None
    before = 0.0
    for feedback in feedback_of(goal):
        progress = float(feedback.feedback.progress_percentage)
        expect(
            0.0 <= progress <= 100.01,
            expected="progress_percentage from 0 to 100",
            observed=f"{progress:g}",
            help="If the goal equals the present pose, do not compute 0/0, which is NaN. Clamp the value to 0 to 100: "
            "it is negative when the robot is farther away than at first.",
            at=feedback.t,
        )
        expect(
            progress >= before - 0.01,
            expected="progress_percentage never to fall",
            observed=f"{progress:.1f} after {before:.1f}",
            help="A detour and the sway of each step increase the distance: publish the largest value so far.",
            at=feedback.t,
        )
        before = progress
    expect(
        before >= COMPLETE or goal.status != SUCCEEDED,
        expected="progress_percentage 100 in the last feedback of a goal that SUCCEEDED",
        observed=f"{before:.1f}",
        help="Publish one more feedback with progress_percentage 100 before succeed().",
        at=goal.result.t if goal.result else None,
    )
    return name_of(GoalStatus, goal.status) if goal.status else None


@obligation(11, of=legs)
def half_done_half_way(leg: Leg) -> str:
    """progress_percentage is about 50 when half of the distance is left"""
    progress = feedback_half_way(leg).feedback.progress_percentage
    low, high = HALF_WAY
    expect(
        low <= progress <= high,
        expected=f"progress_percentage from {low:.0f} to {high:.0f} when half of the distance is left",
        observed=f"{progress:.1f}",
        help="Compare the remaining distance or time with its value when the goal was accepted.",
        at=leg.half,
    )
    return life.phase(leg.goal)


# -- the path, and detours --------------------------------------------------------------------------------------------


@obligation(12, 13, of=goals, see="08_navigation#odometer-why")
def measures_its_path(goal: Goal) -> str | None:
    """distance_traveled is the path of the pelvis during this goal, without sway, however the goal ends"""
    end = goal.result
    if not life.accepted(goal) or end is None or life.interrupted(goal) or life.fell_or_lost_power(goal):
        return None
    detour = led_astray(goal) is not None
    ends_standing = not detour and (goal.status == SUCCEEDED or operated(goal))
    walked = length_walked(goal.run, goal.accepted_at, end.t)
    directly = length_walked(goal.run, goal.accepted_at, end.t, STRIDE)
    claimed = float(end.result.distance_traveled)
    there, here = goal.run.robot_at(goal.accepted_at), goal.run.robot_at(end.t)
    straight = math.hypot(here.x - there.x, here.y - there.y)
    if claimed > walked:
        help = _MEASURE_IN_ODOM if operated(goal) else _OF_EACH_GOAL if life.others(goal) else _COUNTS_SWAY
    elif abs(claimed - straight) < MIN_PATH_SLACK / 2:
        help = (
            "That is the straight distance from start to end: add up all distances along the path, also back."
        )
    else:
        help = "Add to the path in every round of the loop, from acceptance to the end, also while the robot turns."
    slack = max(PATH_SHARE * walked, MIN_PATH_SLACK)
    lost = (2 if detour else 0 if ends_standing else 1) * LOST_AT_A_TURN
    filtered = length_without_sway(goal.run, goal.accepted_at, end.t, GREATEST_FILTER)
    least, most = min(directly - lost, filtered) - slack, walked + slack
    expect(
        least <= claimed <= most,
        expected=f"result.distance_traveled about {walked:.2f} m ({least:.2f} to {most:.2f} m), the path of the pelvis "
        "without its sway",
        observed=f"{claimed:.2f} m",
        help=help,
        at=end.t,
    )
    return f"{name_of(GoalStatus, end.status)}, {life.phase(goal)}"


@obligation(14, 15, of=goals, see="08_navigation#loops-why")
def finds_its_way_back(goal: Goal) -> str | None:
    """After an operator has walked the robot back and turned it, it still arrives"""
    if led_astray(goal) is None:
        return None
    require_arrival(goal)
    return "a detour"


@obligation(15, of=goals, see="08_navigation#recovery-why")
def counts_no_recovery(goal: Goal) -> str | None:
    """number_of_recoveries stays 0 for an undisturbed goal, also after a disturbed one"""
    if not life.accepted(goal) or life.interrupted(goal) or operated(goal) or not feedback_of(goal):
        return None
    counted = max(feedback_of(goal), key=lambda feedback: feedback.feedback.number_of_recoveries)
    expect(
        counted.feedback.number_of_recoveries == 0,
        expected="number_of_recoveries 0, as nothing disturbed the robot during this goal",
        observed=f"{counted.feedback.number_of_recoveries}",
        help="Start at 0 for each goal. Do not count the turn at the start, nor the changing bearing within a step of "
        "the goal: count only if the robot walks, is farther than 0.3 m from the goal, and its heading is more than "
        "0.5 rad off the goal.",
        at=counted.t,
    )
    return life.phase(goal)


@obligation(14, 15, of=goals, see="08_navigation#recovery-why")
def counts_the_detour(goal: Goal) -> str | None:
    """number_of_recoveries counts a detour once"""
    moments = led_astray(goal)
    if moments is None:
        return None
    taken, given = moments
    counts = [each.feedback.number_of_recoveries for each in feedback_of(goal)]
    early = [each.feedback.number_of_recoveries for each in feedback_of(goal) if each.t < taken]
    expect(
        not early or early[-1] == 0,
        expected="number_of_recoveries 0 until something disturbs the robot",
        observed=f"{early[-1] if early else 0}",
        help="Do not count the turn at the start as a recovery.",
        at=taken,
    )
    if not counts:
        raise not_shown(goal.run, f"feedback on “{goal.name}” comes before its result")
    expect(
        1 <= counts[-1] <= MAX_DETOURS,
        expected="number_of_recoveries 1 after one detour",
        observed=f"{counts[-1]}",
        help="Count when the phase changes from walking back to turning, not in every round of the loop."
        if counts[-1]
        else "While the robot walks, compare the goal's bearing with the heading: if they differ by more than 0.5 rad, "
        "go back to the turning phase and add 1.",
        at=given,
    )
    expect(
        sorted(counts) == counts,
        expected="number_of_recoveries never to fall",
        observed=f"{counts}",
        help="Set number_of_recoveries to 0 only when a goal starts.",
        at=given,
    )
    return "a detour"
