"""What must hold for every goal of stand_up, and for the robot, clause by clause, in every scenario."""

from __future__ import annotations

import math
from itertools import groupby, pairwise

from autograder.authoring import (
    ABORTED,
    CANCELED,
    SUCCEEDED,
    Goal,
    Transcript,
    ev,
    expect,
    goals,
    obligation,
    require_fall_reported,
    require_good_feedback_rate,
    whole_run,
    why_no_message_arrives,
    why_rclpy_aborted,
)
from autograder.authoring.walking import life, objections
from autograder.authoring.walking.obligations import ends, reporting
from autograder.authoring.walking.reports import require_error_code
from humanoid_interfaces.msg import RobotState
from ros_runtime.message_constants import GoalStatus, name_of

from . import advice, truth
from .truth import EARLY, GAIN, HEIGHT_SLACK, LATE, RISEN, STANCE, TIME_LIMIT

SHIFTING, RISING, SETTLING = PHASES = ("shifting", "rising", "settling")
ON_ITS_WAY = 1.0  # s for messages of the robot to arrive
AT_ONCE_TIME = 2.5  # s; the task says 2 s
SETTLED = 0.40, 0.10  # s before the result, between which the robot must be settled; the task says for 0.5 s
MIN_UNEVEN_TIME = 0.5  # s; shorter times of uneven loads are not checked
NOTICE_TIME = 0.2  # s of uneven loads, in which a server may still succeed
EVEN_TIME = 0.15  # s; the task forbids rising before 0.3 s of even loads
REACTION_TIME = 0.6  # s for a server to detect uneven loads and for the pelvis to come to rest
STOPPING_RISE = 0.08  # m that the pelvis may still rise; from 0.15 m/s it rises 0.025 m after a zero Twist
FEEDBACK_DELAY = 0.6  # s until a change of the robot appears in the feedback
RISING_SPEED = 0.03  # m/s
MAX_AGE, PERCENT_SLACK, COMPLETE = (
    0.6,
    15.0,
    99.5,
)  # s, the age of a measurement in the feedback; percent; percent
BOB = 0.001  # m; a pelvis that goes down by more is bobbing
CANCEL_TIMEOUT = 5.0  # s, far more than a pelvis needs to come to rest
MIN_DURATION = 1.5  # s; in a shorter goal no feedback rate can be measured
BEGUN = 0.006  # m, more than a pelvis bobs at rest
REST_TIME = 1.0  # s after a cancel or a push, in which the pelvis comes to rest
MIN_REST_SPAN = 0.3  # s; a shorter time at rest is not checked


# -- which goals it accepts -------------------------------------------------------------------------------------------


def _is_known(goal: Goal) -> bool | None:
    """Return whether odom and both loads had reached the server when the goal came; None if that is uncertain."""
    run = life.run_of(goal)
    if run.ground_truth:
        return True
    firsts = [run.published(topic)[:1] for topic in ("odom", "l_foot/wrench", "r_foot/wrench")]
    if not all(first and first[0].t < (goal.answer or goal.sent).t for first in firsts):
        return False
    return True if all(first[0].t < goal.sent.t - ON_ITS_WAY for first in firsts) else None


@obligation(1, 2, of=goals, see="06_walk_to_a_pose#reject-task")
def accepts(goal: Goal) -> str | None:
    """It accepts a goal when the robot crouches or stands, also after others have ended"""
    if _is_known(goal) is not True or truth.lay_on_the_floor(goal):
        return None
    if any(life.overlaps(other, goal) is not False for other in life.others(goal)):
        return None
    run, stands = life.run_of(goal), truth.began_high(goal)
    for last in run.published("odom")[-1:] if goal.answer else ():
        expect(
            last.subscriptions > 0,
            expected="a subscription to odom",
            observed="no subscription when the grader published on odom",
            help='Write create_subscription(Odometry, "odom", …): a relative name, without a leading slash.',
            at=last.t,
        )
    causes = (why_no_message_arrives(run, topic) for topic in ("odom", "robot_state"))
    later = any(result.t < goal.sent.t for result in run.all(ev.ResultReceived))
    help = advice.STANDS_ALREADY if stands else advice.FREE_AGAIN if later else advice.ACCEPT
    goal.require_accepted(next(filter(None, causes), help))
    return f"{'standing' if stands else 'crouching'}, {'after another' if later else 'at first'}"


@obligation(1, of=goals, see="06_walk_to_a_pose#reject-task")
def rejects_the_unknown(goal: Goal) -> str | None:
    """It rejects a goal before the robot's first messages"""
    if _is_known(goal) is not False:
        return None
    goal.require_rejected(because="the robot has not published any message yet", help=advice.UNKNOWN)
    return "before the first messages"


rejects_while_busy = objections.rejects(
    13,
    objections.while_busy,
    sentence="It rejects a goal while another is active",
    see="07_cancel_and_preempt#conventions",
)
takes_one_of_several = obligation(13, of=goals)(objections.one_of_several)


# -- how goals end ----------------------------------------------------------------------------------------------------


@obligation(5, 6, of=goals, see="10_parameters_and_balance#rise-why")
def succeeds(goal: Goal) -> str | None:
    """The goal SUCCEEDS, with base_link at 0.59 m or higher"""
    accepts.require(goal)
    if goal.status != SUCCEEDED and (not truth.could_rise(goal) or life.was_not_awaited(goal)):
        return None
    run, result = life.run_of(goal), goal.result
    if result is None or result.status != SUCCEEDED:
        advice.require_not_given_up(goal)
        result = goal.require_result(SUCCEEDED)
    height = max(each.z for each in truth.bodies(run, result.t - 0.3, result.t))
    expect(
        height >= RISEN - HEIGHT_SLACK,
        expected=f"base_link at {RISEN} m or higher when the goal SUCCEEDED",
        observed=f"base_link at {height:.3f} m",
        help=advice.about_the_height(goal, height),
        at=result.t,
    )
    return "pushed" if truth.was_pushed(goal) else "undisturbed"


@obligation(5, 7, of=goals, see="10_parameters_and_balance#phases-why")
def rises_though_pushed(goal: Goal) -> str | None:
    """When the robot is pushed while it rises, the goal still SUCCEEDS"""
    return succeeds.require(goal) if truth.was_pushed(goal) else None


@obligation(6, of=goals, see="10_parameters_and_balance#still-why")
def settles(goal: Goal) -> str | None:
    """When the goal SUCCEEDS, base_link has been at full height, still and upright for 0.5 s"""
    if goal.status != SUCCEEDED or not goal.result:
        return None
    begin, end = (goal.result.t - before for before in SETTLED)
    for body in truth.bodies(life.run_of(goal), begin, end):
        expect(
            not body.unrest,
            expected=f"base_link at {RISEN} m or higher, slower than 0.02 m/s and tilted by less than 0.05 rad, during "
            "the last 0.5 s before the goal SUCCEEDED",
            observed=f"{body.unrest}, {goal.result.t - body.t:.1f} s before the result",
            help="Call succeed() only when the height, speed and tilt in odom have all been within their limits for "
            "0.5 s without a break.",
            at=body.t,
        )
    return "the simulator's robot" if goal.run.ground_truth else "the scenario's robot"


@obligation(2, of=goals, see="10_parameters_and_balance#phases-why")
def says_that_it_stands(goal: Goal) -> str | None:
    """A goal when the robot already stands is ABORTED at once with ALREADY_STANDING"""
    if not life.accepted(goal) or not truth.began_high(goal) or life.interrupted(goal):
        return None
    result = goal.require_result(
        ABORTED, help="The goal changed nothing, so it has not succeeded: call abort() with ALREADY_STANDING."
    )
    require_error_code(goal, "ALREADY_STANDING", because="the robot already stands")
    _require_at_once(goal, result, "Compare odom's height with 0.59 m before the first phase.")
    return "after a rise" if life.others(goal) else "at first"


@obligation(15, of=goals, see="07_cancel_and_preempt#fall-why")
def ends_with_a_fall(goal: Goal) -> str | None:
    """When the robot falls, the goal is ABORTED with FELL"""
    if not truth.began_low(goal) or life.granted(goal) or goal.status == SUCCEEDED:
        return None
    fallen = truth.fallen_during(goal)
    if fallen is None:
        return None
    require_fall_reported(goal, fallen)
    return "a fall"


@obligation(16, of=goals, see="07_cancel_and_preempt#fall-why")
def refuses_the_floor(goal: Goal) -> str | None:
    """A goal when the robot has fallen is rejected, or ABORTED at once with FELL"""
    if not truth.lay_on_the_floor(goal):
        return None
    if not life.accepted(goal):
        goal.require_rejected(because="the robot has fallen", help=advice.FALLEN)
        return "rejected"
    result = goal.require_result(ABORTED, help=advice.FALLEN)
    require_error_code(goal, "FELL", because="the robot has fallen")
    _require_at_once(goal, result, advice.FALLEN)
    return "aborted"


@obligation(12, of=goals, see="07_cancel_and_preempt#m1-why")
def cancels(goal: Goal) -> str | None:
    """A cancel at any moment is accepted, and the goal ends CANCELED"""
    over = life.ended_at(goal) if goal.status == SUCCEEDED else goal.run.end
    asked = [each for each in goal.cancels if goal.answer and goal.answer.t <= each.sent.t < over]
    if not asked or not truth.began_low(goal):
        return None
    asked[0].require_agreed(goal)
    took = goal.require_result(CANCELED).t - asked[0].sent.t
    expect(
        took <= CANCEL_TIMEOUT,
        expected=f"the goal to end CANCELED soon after the cancel, within {CANCEL_TIMEOUT:g} s",
        observed=f"it ended {took:.1f} s after the cancel",
        help="Test is_cancel_requested in every phase, before you test whether the phase is over.",
        at=goal.result.t if goal.result else None,
    )
    return _phase_at(goal, asked[0].sent.t)


@obligation(14, of=goals, see="08_navigation#late-why")
def keeps_the_limit(goal: Goal) -> str | None:
    """A goal that has not succeeded within 12 s is ABORTED at that time, not earlier"""
    if not truth.began_low(goal) or life.granted(goal) or truth.fallen_during(goal) or life.interrupted(goal):
        return None
    in_time = goal.status == SUCCEEDED and life.ended_at(goal) <= goal.accepted_at + TIME_LIMIT + LATE
    if in_time or life.was_not_awaited(goal):
        return None
    result = goal.require_result(ABORTED, help=advice.TIME_IS_UP)
    took = result.t - goal.accepted_at
    expect(
        TIME_LIMIT - EARLY <= took <= TIME_LIMIT + LATE,
        expected=f"the goal ABORTED {TIME_LIMIT:g} s after it was accepted",
        observed=f"ABORTED after {took:.1f} s",
        help="Store the time of acceptance once, and compare with it in every round of every phase."
        if took > TIME_LIMIT
        else why_rclpy_aborted(goal) or "The robot had not fallen: continue the goal until 12 s are over.",
        at=result.t,
    )
    return "held" if truth.was_held(goal) else "it could have risen"


@obligation(17, of=goals)
def names_no_error(goal: Goal) -> str | None:
    """The error_code is NONE, unless the robot already stood or has fallen"""
    if not life.accepted(goal) or not goal.result or truth.began_high(goal):
        return None
    if truth.lay_on_the_floor(goal) or life.interrupted(goal) or truth.fallen_during(goal):
        return None
    require_error_code(goal, "NONE", because="StandUp has no error_code for this way to end")
    return name_of(GoalStatus, goal.result.status)


says_why_it_aborted = obligation(17, of=goals)(reporting.says_why_it_aborted)
status_in_order = obligation(12, of=goals)(ends.status_in_order)


# -- what the robot does ----------------------------------------------------------------------------------------------


@obligation(3, of=whole_run, see="01_robot_and_graph#walk-intro")
def rises_in_place(run: Transcript) -> str | None:
    """The robot rises without taking a step"""
    if not run.ground_truth or truth.pushes(run):
        return None  # a push may make the robot take a step
    for robot in run.ground_truth:
        expect(
            robot.mode != RobotState.WALKING,
            expected="the robot to rise without taking a step",
            observed="it walked",
            help="Leave linear.x, linear.y and angular.z at 0: any of them makes the robot walk.",
            at=robot.t,
        )
    return "all the time"


@obligation(4, of=goals, see="10_parameters_and_balance#still-why")
def stays_down_while_uneven(goal: Goal) -> str | None:
    """The robot stays down until the loads have been even for 0.3 s without a break"""
    if not truth.began_low(goal):
        return None
    run, (at, end) = life.run_of(goal), truth.lifetime(goal)
    even = _first_even(goal, end)
    if even is None or even < at + MIN_UNEVEN_TIME:
        return None
    if run.ground_truth:
        start = run.robot_at(at).z
        highest = max(run.robot_between(at, even), key=lambda robot: robot.z)
        rose, when = highest.z > start + GAIN, highest.t
        how = f"it rose from {start:.2f} to {highest.z:.2f} m"
    else:
        early = [
            each.t for each in run.received("cmd_vel") if at <= each.t < even and each.message.linear.z > 0
        ]
        rose, when, how = bool(early), min(early, default=at), "cmd_vel had linear.z above 0"
    expect(
        not rose,
        expected="the pelvis to stay down until the loads have been even for 0.3 s",
        observed=f"{how}, with loads of {_loads_at(run, when)}",
        help="Subscribe to l_foot/wrench and r_foot/wrench: force.z is the load on a foot. Rise only when the smaller "
        "load has been at least 0.8 of the larger for 0.3 s.",
        at=when,
    )
    return "leaned on" if run.ground_truth else "swaying"


def _first_even(goal: Goal, end: float) -> float | None:
    """Return until when (s) the robot must stay down, as its loads were not even for long. None: no loads are known."""
    since, last = None, None
    for each in truth.loads(life.run_of(goal), goal.accepted_at, end):
        last = each.t
        if truth.share(each) < 0.78:
            since = None
        elif since is None:
            since = each.t
        elif each.t - since > EVEN_TIME:
            return since + EVEN_TIME
    return last


@obligation(7, of=goals, see="10_parameters_and_balance#phases-why")
def shifts_again(goal: Goal) -> str | None:
    """Uneven loads stop the rising or settling robot, and the goal does not succeed before they are even again"""
    if not truth.began_low(goal):
        return None
    run, judged = life.run_of(goal), None
    for uneven, even in truth.uneven_spans(run, *truth.lifetime(goal), NOTICE_TIME):
        before = truth.height_at(run, uneven)
        if before < truth.height_at(run, goal.accepted_at) + BEGUN:
            continue
        expect(
            goal.status != SUCCEEDED or even < life.ended_at(goal) - NOTICE_TIME,
            expected="no success while one foot carries much more than the other",
            observed=f"the goal SUCCEEDED with loads of {_loads_at(run, even)}",
            help="Compare the loads in every phase, also in 'settling'.",
            at=life.ended_at(goal),
        )
        if even - uneven < REACTION_TIME + 0.1:
            continue
        highest = max(truth.bodies(run, uneven + REACTION_TIME, even), key=lambda body: body.z)
        expect(
            before > RISEN - STOPPING_RISE or highest.z <= before + STOPPING_RISE,
            expected="the pelvis to stop while one foot carries much more than the other",
            observed=f"it rose from {before:.2f} to {highest.z:.2f} m, with loads of {_loads_at(run, highest.t)}",
            help="Compare the loads also in the phase 'rising': when the smaller is below 0.6 of the larger, publish a "
            "zero Twist and go back to 'shifting'.",
            at=highest.t,
        )
        judged = "settling" if before >= RISEN - STOPPING_RISE else "rising"
    return judged


@obligation(9, of=goals)
def names_shifting(goal: Goal) -> str | None:
    """feedback.phase is 'shifting' while the loads are uneven"""
    if not truth.began_low(goal):
        return None
    run, judged = life.run_of(goal), 0
    for uneven, even in truth.uneven_spans(run, *truth.lifetime(goal), MIN_UNEVEN_TIME):
        for each in goal.feedback:
            if uneven + FEEDBACK_DELAY <= each.t <= even:
                judged += 1
                expect(
                    each.feedback.phase == SHIFTING,
                    expected="feedback.phase 'shifting' while the loads are uneven",
                    observed=f"{each.feedback.phase!r}, with loads of {_loads_at(run, each.t)}",
                    help="Stay in 'shifting' until the loads have been even for 0.3 s. Go back to it from 'rising' and "
                    "from 'settling' when they become uneven.",
                    at=each.t,
                )
    return "uneven loads" if judged else None


@obligation(12, 14, of=goals, see="07_cancel_and_preempt#m12-robot-why")
def stays_where_it_ended(goal: Goal) -> str | None:
    """After a cancel or an abort, the pelvis stays at the height that it has reached"""
    if not life.accepted(goal) or goal.status not in (CANCELED, ABORTED) or not goal.run.ground_truth:
        return None
    if not goal.result or truth.lay_on_the_floor(goal) or truth.fallen_during(goal) or life.interrupted(goal):
        return None
    asked = min([each.sent.t for each in life.granted(goal)], default=goal.result.t)
    later = [other.sent.t for other in life.others(goal)]
    moved = [each.t for each in goal.run.commands("move_body")]
    disturbances = truth.pushes(life.run_of(goal))
    next_ones = [*later, *moved, *(first for first, _ in disturbances)]
    end = min((t for t in next_ones if t > asked), default=goal.run.end)
    begin = max([asked, *(last for first, last in disturbances if first <= asked)]) + REST_TIME
    if end < begin + MIN_REST_SPAN:
        return None
    at = goal.run.robot_at(asked).z
    after = goal.run.robot_between(begin, end)
    lowest, highest = min(after, key=lambda robot: robot.z), max(after, key=lambda robot: robot.z)
    wrong = highest if highest.z > at + STOPPING_RISE else lowest
    expect(
        at - GAIN <= lowest.z and highest.z <= at + STOPPING_RISE,
        expected=f"the pelvis to stay at about {at:.2f} m, where it was at {asked:.1f} s",
        observed=f"it moved to {wrong.z:.2f} m",
        help="Publish a zero Twist before you end the goal, and nothing on cmd_vel afterwards. Without the zero Twist "
        "the robot goes on rising for 0.5 s."
        if highest.z > at + STOPPING_RISE
        else "Do not make the robot crouch again: a zero Twist holds its height.",
        at=wrong.t,
    )
    expect(
        highest.z - lowest.z <= GAIN / 2,
        expected="the pelvis at rest 1 s after the end",
        observed=f"it moved between {lowest.z:.3f} and {highest.z:.3f} m",
        help="Once the goal has ended, publish only zero on cmd_vel: stop the timer or thread that publishes other "
        "values.",
        at=highest.t,
    )
    return name_of(GoalStatus, goal.result.status)


# -- what the feedback says -------------------------------------------------------------------------------------------


@obligation(8, of=goals, see="06_walk_to_a_pose#settle-intro")
def feedback_at_5_hz(goal: Goal) -> str | None:
    """Feedback is published at 5 Hz, without a gap of more than 1 s"""
    if not truth.began_low(goal) or life.was_not_awaited(goal) or life.interrupted(goal):
        return None
    if life.ended_at(goal) < goal.accepted_at + MIN_DURATION and not why_rclpy_aborted(goal):
        return None
    require_good_feedback_rate(goal)
    return "all the time"


feedback_ends = obligation(8, of=goals, see="07_cancel_and_preempt#m13-why")(
    reporting.feedback_ends_with_the_goal
)


@obligation(9, of=goals, see="10_parameters_and_balance#phases-why")
def names_its_phase(goal: Goal) -> str | None:
    """feedback.phase is 'shifting', 'rising' or 'settling', as the robot moves"""
    feedback = _before_the_end(goal)
    undisturbed = goal.run.ground_truth and not truth.was_pushed(goal)
    for each in feedback:
        expect(
            each.feedback.phase in PHASES,
            expected="feedback.phase 'shifting', 'rising' or 'settling'",
            observed=f"{each.feedback.phase!r}",
            help="Spell the phases exactly as the task does.",
            at=each.t,
        )
        if undisturbed:
            _require_seen_phase(goal, each)
    has_risen = goal.status == SUCCEEDED and undisturbed
    if feedback and has_risen and not truth.uneven_spans(life.run_of(goal), *truth.lifetime(goal), 0.0):
        seen = [phase for phase, _ in groupby(each.feedback.phase for each in feedback)]
        expect(
            seen in (list(PHASES), list(PHASES[1:])),
            expected="feedback.phase 'shifting', then 'rising', then 'settling'",
            observed=", ".join(map(repr, seen)),
            help="Keep the phase in a variable, change it when a measurement ends the phase, and copy it to "
            "feedback.phase.",
            at=feedback[0].t,
        )
        return "in order"
    return "words" if feedback else None


def _require_seen_phase(goal: Goal, each: ev.FeedbackReceived) -> None:
    """Require that the robot rises only in the phase 'rising', and that 'settling' begins at the full height."""
    run, phase = life.run_of(goal), each.feedback.phase
    recent = run.robot_between(each.t - FEEDBACK_DELAY / 2, each.t)
    highest = max(robot.z for robot in recent)
    rises = min(truth.climb(run, robot.t) for robot in recent) > 2 * RISING_SPEED and highest < RISEN - GAIN
    expect(
        phase == RISING or not rises,
        expected="feedback.phase 'rising' while the pelvis moves up",
        observed=f"{phase!r} while it moved up, at {recent[-1].z:.3f} m",
        help="Change to 'rising' when you begin to publish linear.z, and to 'settling' when odom's height is 0.59 m.",
        at=each.t,
    )
    expect(
        phase != SETTLING or highest >= RISEN - GAIN,
        expected=f"feedback.phase 'settling' only when the pelvis is at {RISEN} m or higher",
        observed=f"'settling' at {recent[-1].z:.3f} m",
        help="Change to 'settling' when odom's height is 0.59 m, not after a fixed time.",
        at=each.t,
    )


@obligation(10, of=goals, see="08_navigation#zero-why")
def measures_percent(goal: Goal) -> str | None:
    """percent_complete is the share of the way from the height at acceptance to 0.60 m, and 100 at success"""
    feedback = _before_the_end(goal)
    if not feedback or not truth.began_low(goal) or truth.fallen_during(goal):
        return None
    run, start = life.run_of(goal), truth.height_at(life.run_of(goal), goal.accepted_at)
    for each in feedback:
        percent = float(each.feedback.percent_complete)
        recent = truth.bodies(run, max(goal.accepted_at - 0.1, each.t - MAX_AGE), each.t)
        true = [max(0.0, 100 * (body.z - start) / (STANCE - start)) for body in recent]
        near = 0.0 if truth.was_pushed(goal) else PERCENT_SLACK
        expect(
            0.0 <= percent <= 100.01 and (not near or min(true) - near <= percent <= max(true) + near),
            expected=f"percent_complete about {true[-1]:.0f}: the pelvis has risen by that share of its way to 0.60 m",
            observed=f"{percent:.0f}",
            help="Compute it from odom: 100 * (height - height at acceptance) / (0.60 - height at acceptance), limited "
            "to 0 to 100.",
            at=each.t,
        )
    if goal.status == SUCCEEDED:
        last = feedback[-1]
        expect(
            last.feedback.percent_complete >= COMPLETE,
            expected="percent_complete 100 in the last feedback of a goal that SUCCEEDED",
            observed=f"{last.feedback.percent_complete:.1f}",
            help="Publish one more feedback with percent_complete 100 before succeed().",
            at=last.t,
        )
    return f"from {math.floor(10 * start) / 10:.1f} m"


@obligation(11, of=goals, see="08_navigation#zero-why")
def never_loses_percent(goal: Goal) -> str | None:
    """percent_complete never falls, except when uneven loads lead back to 'shifting'"""
    feedback, has_risen = _before_the_end(goal), False
    for before, after in pairwise(feedback):
        has_risen = has_risen or before.feedback.phase != SHIFTING
        was, now = before.feedback.percent_complete, after.feedback.percent_complete
        expect(
            now >= was - 0.01 or (has_risen and after.feedback.phase == SHIFTING),
            expected="percent_complete never to fall, except on the way back to 'shifting'",
            observed=f"{now:.1f} after {was:.1f}, in the phase {after.feedback.phase!r}",
            help="The pelvis bobs by some millimetres: publish the largest value so far, and reset it only when you "
            "change to 'shifting'.",
            at=after.t,
        )
    if len(feedback) < 2:
        return None
    if goal.run.ground_truth:
        return "simulated"
    heights = [body.z for body in truth.bodies(life.run_of(goal), *truth.lifetime(goal))]
    return "bobbing" if any(later < earlier - BOB for earlier, later in pairwise(heights)) else None


def _before_the_end(goal: Goal) -> list[ev.FeedbackReceived]:
    if not life.accepted(goal):
        return []
    return [each for each in goal.feedback if not goal.result or each.t <= goal.result.t]


def _require_at_once(goal: Goal, result: ev.ResultReceived, help: str) -> None:
    took = result.t - goal.accepted_at
    expect(
        took <= AT_ONCE_TIME,
        expected="the result within 2 s after acceptance",
        observed=f"the result came after {took:.1f} s",
        help=help,
        at=result.t,
    )


def _phase_at(goal: Goal, t: float) -> str:
    """Return the phase that the robot's height at a time (s) suggests, for the table of clauses."""
    z, start = truth.height_at(life.run_of(goal), t), truth.height_at(life.run_of(goal), goal.accepted_at)
    return "shifting" if z < start + BEGUN else "settling" if z >= RISEN else "rising"


def _loads_at(run: Transcript, t: float) -> str:
    sample = min(truth.loads(run, t - 1.0, t + 1.0), key=lambda sample: abs(sample.t - t), default=None)
    return f"{sample.left:.0f} and {sample.right:.0f} N" if sample else "unknown"
