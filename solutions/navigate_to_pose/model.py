"""What must hold of every goal of navigate_to_pose, and of the robot while none is active, clause by clause."""

from __future__ import annotations

import math
import re
from collections import Counter

from autograder.authoring import ABORTED, SUCCEEDED, Goal, ev, expect, goals, not_shown, obligation, whole_run
from autograder.authoring.walking import life, objections
from autograder.authoring.walking.objections import accepting, objection, rejects
from autograder.authoring.walking.obligations import cancels, ends, reporting, walks
from autograder.authoring.walking.path import STRIDE, length_walked, walking_speed
from autograder.authoring.walking.planar import error
from autograder.authoring.walking.reports import require_error_code
from autograder.authoring.walking.truth import require_arrival, require_stopped
from ros_runtime.message_constants import GoalStatus, name_of

from .legs import Leg, led_astray, legs, off_the_way, operated, told, told_half_way, under_way

SMALLEST = 0.05  # m, of a tolerance
HERE = 0.05  # m or rad that the present pose may be off
HERE_TIME = 4.0  # s
STAYED = 0.10  # m the pelvis may move while the robot only stands
# s a TIMEOUT may come too early, and too late: the robot has to stand first
TIMEOUT_EARLY, TIMEOUT_LATE = 1.5, 4.0
FACING = 0.6  # rad between heading and goal while it walks
IN_PLACE = 0.10  # m/s of the body as a whole
# of the greatest speed, and turn rate in place, that the robot had on this leg
WALKS, STANDS, TURNS = 0.7, 0.4, 0.5
TIME_SLACK = 1.0  # s that a reported time may be off: feedback's period and delivery
FACTOR = 2.0  # by which an estimate may be off
HALF_WAY = 25.0, 75.0  # percent
COMPLETE = 99.5  # percent
# m where the robot turns back, or goes on: half a leg before it and half a leg after it go uncounted
LOST = 0.2
SHARE, LEAST = 0.15, 0.25  # of the path, or m (more than a step), that distance_traveled may be off
MOST_DETOURS = 3  # one is right; who counts the turn back and the walk back as two is right, too
_NUMBER = re.compile(r"[-+]?\d+([.,]\d+)?")
_COUNTS_SWAY = (
    "The pelvis sways 3 cm to each side with every step, also while the robot turns on the spot. Count a leg only when "
    "odom is 0.15 m away from where the last one ended."
)
_ODOM_TELLS = "Count legs of the way in odom: the robot may not obey what you publish on cmd_vel."
_OF_EACH_GOAL = "Begin the sum at 0 in every goal: keep it in execute, not in the node."


# -- which goals it accepts -------------------------------------------------------------------------------------------


@objection(
    "0 asks for the default of 0.10 m; anything else below 0.05 m is rejected, negative numbers and NaN too: "
    "NaN < 0.05 is false, so ask math.isfinite() as well."
)
def _tolerances(goal: Goal) -> str | None:
    """It rejects a tolerance that is NaN, or below 0.05 m and not 0."""
    tolerance = goal.request.tolerance
    if abs(tolerance - SMALLEST) < 1e-6:
        return None  # as a float it may be a little less
    can_be_kept = tolerance == 0.0 or tolerance >= SMALLEST
    return "" if can_be_kept else f"a tolerance of {tolerance:g} m cannot be kept"


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
        took <= HERE_TIME,
        expected=f"success within {HERE_TIME:.0f} s: the robot is there already",
        observed=f"it came after {took:.1f} s",
        help="Look whether the robot is there before you look where to turn: at distance 0 the bearing means nothing.",
        at=end.t,
    )
    steps = goal.run.robot_at(end.t).steps - goal.run.robot_at(goal.sent.t).steps
    expect(
        steps == 0,
        expected="success without a step: the robot is there already",
        observed=f"{steps} steps",
        help="Publish no velocity but zero when distance and turn are within the tolerance from the beginning.",
        at=end.t,
    )
    distance = float(end.result.distance_traveled)
    expect(
        0.0 <= distance <= STAYED,
        expected="distance_traveled 0 m: the robot did not walk",
        observed=f"{distance:.2f} m",
        help="Begin the path of each goal at 0, where the robot is when it is accepted.",
        at=end.t,
    )
    return life.phase(goal)


@obligation(16, of=goals, see="08_navigation#late-why")
def gives_up_in_time(goal: Goal) -> str | None:
    """A goal that is not reached 30 s and 15 s per metre after its acceptance ends ABORTED with TIMEOUT, not before"""
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
        help="Compare the time since acceptance with the limit in every round, also while the robot does not get on.",
    )
    require_error_code(goal, "TIMEOUT", because="the time is over")
    expect(
        limit - TIMEOUT_EARLY <= lasted <= limit + TIMEOUT_LATE,
        expected=f"TIMEOUT {limit:.0f} s after acceptance, 30 s and 15 s per metre that was to go then",
        observed=f"it came after {lasted:.1f} s",
        help="Compute the limit once, from the distance at acceptance, and count from acceptance.",
        at=end.t,
    )
    return "held" if operated(goal, "hold") else "under way"


@obligation(16, of=goals, see="06_walk_to_a_pose#touch-why")
def stands_after_the_limit(goal: Goal) -> str | None:
    """After TIMEOUT the robot stands still, also when it is let go"""
    if not _timed_out(goal) or not operated(goal, "hold"):
        return None
    require_stopped(goal.run, goal.run.last_command("take_over", velocity=None).t, event="being let go")
    return "let go"


def _timed_out(goal: Goal) -> bool:
    result = goal.result
    return bool(result and result.status == ABORTED and result.result.error_code == result.result.TIMEOUT)


# -- how it goes, and what the feedback says of it --------------------------------------------------------------------

feedback_at_5_hz = obligation(6, of=goals, see="06_walk_to_a_pose#settle-intro")(reporting.feedback_at_5_hz)
feedback_ends_with_the_goal = obligation(6, of=goals, see="07_cancel_and_preempt#m13-why")(
    reporting.feedback_ends_with_the_goal
)
feedback_is_true = obligation(7, of=goals, see="08_navigation#action-intro")(reporting.feedback_is_true)


@obligation(3, of=legs, see="08_navigation#why")
def faces_its_way(leg: Leg) -> str:
    """It turns toward the goal, then walks straight ahead: it faces the goal in the middle of its way"""
    run = leg.goal.run
    for robot in run.robot_between(leg.half - 1.0, leg.half + 0.5):
        if walking_speed(run, robot.t) < IN_PLACE:
            continue
        off = off_the_way(robot, leg.goal)
        expect(
            off <= FACING,
            expected="the robot to turn toward the goal first, and to walk straight ahead",
            observed=f"it walks with its heading {off:.1f} rad off the goal",
            help="While the goal is farther than 0.3 m, publish angular.z alone until math.atan2(dy, dx) minus the "
            "heading is small; only then linear.x.",
            at=robot.t,
        )
    return life.phase(leg.goal)


@obligation(8, of=legs, see="08_navigation#loops-intro")
def names_its_phases(leg: Leg) -> str:
    """The walk has a status of its own, and the turns before and after it have others"""
    goal = leg.goal
    moves = [
        (robot, walking_speed(goal.run, robot.t))
        for robot in goal.run.robot_between(leg.start, leg.end)[::10]
    ]
    fastest = max(speed for _, speed in moves)
    in_place = min(IN_PLACE, STANDS * fastest)
    turn_rate = TURNS * max((abs(robot.turn_rate) for robot, speed in moves if speed < in_place), default=0.0)

    def turns(robot: ev.RobotTruth, speed: float) -> bool:
        return speed < in_place and abs(robot.turn_rate) > turn_rate

    turning = _statuses(goal, leg.start, leg.half, turns)
    walking = _statuses(goal, leg.start, leg.end, lambda robot, speed: speed > WALKS * fastest)
    aligning = _statuses(goal, leg.half, leg.end, turns)
    for what, statuses in (
        ("it turns toward the goal", turning),
        ("it walks", walking),
        ("it turns to the goal's heading", aligning),
    ):
        if not statuses:
            raise not_shown(goal.run, f"feedback comes while {what}")
        expect(
            all(status.strip() for status in statuses),
            expected=f"feedback.status to say in words that {what}",
            observed="an empty status",
            help="Keep the phase in a variable, change it where the loop changes what it does, and copy it to "
            "feedback.status.",
        )
    names = [statuses.most_common(1)[0][0] for statuses in (turning, walking, aligning)]
    expect(
        names[1] not in (names[0], names[2]),
        expected="a status of its own for the walk, and others for the turns before and after it",
        observed=f"{names[0]!r} as it turns, {names[1]!r} as it walks, {names[2]!r} as it turns to the heading",
        help="Set the phase where the loop decides to turn, to walk or to align, and send that.",
        at=leg.half,
    )
    return life.phase(goal)


def _statuses(goal: Goal, start: float, end: float, during) -> Counter[str]:
    """Count the statuses of the feedback, without the numbers in them, while the robot did something."""
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
    start, reports = goal.accepted_at, told(goal)
    if not reports or reports[-1].t - start < 2 * TIME_SLACK:
        return None
    for feedback in reports:
        claimed, true = reporting.seconds(feedback.feedback.navigation_time), feedback.t - start
        expect(
            abs(claimed - true) <= TIME_SLACK,
            expected=f"navigation_time near {true:.1f} s, since the goal was accepted",
            observed=f"{claimed:.1f} s",
            help="Remember when the goal is accepted, and subtract that: neither the node's start nor the phase's."
            if claimed
            else "Fill feedback.navigation_time from the time since the goal was accepted.",
            at=feedback.t,
        )
    return life.phase(goal)


@obligation(10, of=legs, see="08_navigation#eta-why")
def estimates_the_time(leg: Leg) -> str:
    """estimated_time_remaining is positive under way, and right within a factor of 2 half way"""
    for feedback in under_way(leg.goal):
        estimate = reporting.seconds(feedback.feedback.estimated_time_remaining)
        expect(
            estimate > 0,
            expected="estimated_time_remaining above 0 while the robot is under way",
            observed=f"{estimate:.2f} s",
            help="Fill it in every feedback, with rclpy.duration.Duration(seconds=…).to_msg(): int seconds alone are 0 "
            "for the last second, and a speed of 0 divides by zero.",
            at=feedback.t,
        )
    estimate = reporting.seconds(told_half_way(leg).feedback.estimated_time_remaining)
    left = leg.end - leg.half
    expect(
        left / FACTOR <= estimate <= left * FACTOR,
        expected=f"estimated_time_remaining from {left / FACTOR:.1f} to {left * FACTOR:.1f} s half way, as it took "
        f"{left:.1f} s more",
        observed=f"{estimate:.1f} s",
        help="Divide what is left by the speed that the robot really has while it walks, and add the time of the last "
        "turn and of standing still.",
        at=leg.half,
    )
    return life.phase(leg.goal)


@obligation(5, 11, of=goals, see="08_navigation#zero-why")
def progress_rises(goal: Goal) -> str | None:
    """progress_percentage is 0 to 100, never falls, and is 100 in the last feedback before the goal SUCCEEDED"""
    if not life.accepted(goal) or life.interrupted(goal) or not (told(goal) or goal.status == SUCCEEDED):
        return None
    before = 0.0
    for feedback in told(goal):
        progress = float(feedback.feedback.progress_percentage)
        expect(
            0.0 <= progress <= 100.01,
            expected="progress_percentage from 0 to 100",
            observed=f"{progress:g}",
            help="0/0 is NaN where nothing is left to walk, and a longer way than at first is below 0: clamp it.",
            at=feedback.t,
        )
        expect(
            progress >= before - 0.01,
            expected="progress_percentage never to fall",
            observed=f"{progress:.1f} after {before:.1f}",
            help="A detour makes the way longer, and sway does so with every step: publish the largest value so far.",
            at=feedback.t,
        )
        before = progress
    expect(
        before >= COMPLETE or goal.status != SUCCEEDED,
        expected="100 percent in the last feedback of a goal that SUCCEEDED",
        observed=f"{before:.1f}",
        help="Publish one more feedback with progress_percentage 100 before succeed().",
        at=goal.result.t if goal.result else None,
    )
    return name_of(GoalStatus, goal.status) if goal.status else None


@obligation(11, of=legs)
def half_done_half_way(leg: Leg) -> str:
    """progress_percentage is about half where half of the distance is left"""
    progress = told_half_way(leg).feedback.progress_percentage
    low, high = HALF_WAY
    expect(
        low <= progress <= high,
        expected=f"progress_percentage from {low:.0f} to {high:.0f} where half of the distance is left",
        observed=f"{progress:.1f}",
        help="Compare what is left, in metres or in seconds, with what was left when the goal was accepted.",
        at=leg.half,
    )
    return life.phase(leg.goal)


# -- the path, and detours --------------------------------------------------------------------------------------------


@obligation(12, 13, of=goals, see="08_navigation#odometer-why")
def measures_its_path(goal: Goal) -> str | None:
    """distance_traveled is the path of the pelvis without its sway, walked for this goal, however it ends"""
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
        help = _ODOM_TELLS if operated(goal) else _OF_EACH_GOAL if life.others(goal) else _COUNTS_SWAY
    elif abs(claimed - straight) < LEAST / 2:
        help = (
            "That is the straight distance from start to end: add up the legs of the path, and the way back."
        )
    else:
        help = "Count the path in every round of the loop, from acceptance to the end, also while the robot turns."
    slack = max(SHARE * walked, LEAST)
    least, most = directly - slack - (2 if detour else 0 if ends_standing else 1) * LOST, walked + slack
    expect(
        least <= claimed <= most,
        expected=f"result.distance_traveled near {walked:.2f} m ({least:.2f} to {most:.2f} m), the path of the pelvis "
        "without its sway",
        observed=f"{claimed:.2f} m",
        help=help,
        at=end.t,
    )
    return f"{name_of(GoalStatus, end.status)}, {life.phase(goal)}"


@obligation(14, 15, of=goals, see="08_navigation#loops-why")
def finds_its_way_back(goal: Goal) -> str | None:
    """Led back and turned by a remote control, the robot finds its way again, and arrives"""
    if led_astray(goal) is None:
        return None
    require_arrival(goal)
    return "led astray"


@obligation(15, of=goals, see="08_navigation#recovery-why")
def counts_no_recovery(goal: Goal) -> str | None:
    """number_of_recoveries stays 0 while nothing disturbs the robot, also after a goal on whose way something did"""
    if not life.accepted(goal) or life.interrupted(goal) or operated(goal) or not told(goal):
        return None
    counted = max(told(goal), key=lambda feedback: feedback.feedback.number_of_recoveries)
    expect(
        counted.feedback.number_of_recoveries == 0,
        expected="number_of_recoveries 0: nothing disturbed the robot on the way to this goal",
        observed=f"{counted.feedback.number_of_recoveries}",
        help="Count for each goal anew. The turn at the start is no recovery, nor is a bearing that swings when the "
        "goal is a step away: count only when the robot walks, farther than 0.3 m from the goal, and is off by more "
        "than 0.5 rad.",
        at=counted.t,
    )
    return life.phase(goal)


@obligation(14, 15, of=goals, see="08_navigation#recovery-why")
def counts_the_detour(goal: Goal) -> str | None:
    """number_of_recoveries counts a detour, once"""
    moments = led_astray(goal)
    if moments is None:
        return None
    taken, given = moments
    counts = [each.feedback.number_of_recoveries for each in told(goal)]
    early = [each.feedback.number_of_recoveries for each in told(goal) if each.t < taken]
    expect(
        not early or early[-1] == 0,
        expected="number_of_recoveries 0 until something disturbs the robot",
        observed=f"{early[-1] if early else 0}",
        help="The turn at the start is no recovery.",
        at=taken,
    )
    if not counts:
        raise not_shown(goal.run, f"feedback on “{goal.name}” comes before its result")
    expect(
        1 <= counts[-1] <= MOST_DETOURS,
        expected="number_of_recoveries 1 after the robot was led astray once",
        observed=f"{counts[-1]}",
        help="Count where the walking phase changes back to turning, not in every round of the loop."
        if counts[-1]
        else "While it walks, compare the goal's bearing with the heading: beyond 0.5 rad go back to the turning phase "
        "and add 1.",
        at=given,
    )
    expect(
        sorted(counts) == counts,
        expected="number_of_recoveries never to fall",
        observed=f"{counts}",
        help="Count for the whole goal.",
        at=given,
    )
    return "led astray"
