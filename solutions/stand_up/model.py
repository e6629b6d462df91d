"""What must hold of every goal of stand_up, and of the robot, clause by clause, in every scenario."""

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
SETTLED = 0.40, 0.10  # s before the result, from when to when it must have been settled; 0.5 s are asked for
LEANED = 0.5  # s that loads have to be uneven to be judged
NOTICE_TIME = 0.2  # s of uneven loads that a server sees before it succeeds
EVEN_TIME = 0.15  # s, less than the 0.3 s of even loads before which it must not rise
REACTION = 0.6  # s for a server to see that, and for the pelvis to come to rest
STOPPING = 0.08  # m that the pelvis may rise while it stops; at 0.15 m/s it rises 0.025 m after a zero Twist has come
FEEDBACK_DELAY = 0.6  # s for a change of the robot to show in the feedback
CLIMBS = 0.03  # m/s
AGE, PERCENT_SLACK, COMPLETE = 0.6, 15.0, 99.5  # s that a report may be old; percent
BOB = 0.001  # m that a pelvis has to go down to be seen to bob
CANCELING = 5.0  # s after a cancel, far more than a pelvis needs to come to rest
MIN_DURATION = 1.5  # s; a goal of less says little about a rate
BEGUN = 0.006  # m, more than a pelvis bobs at rest
AT_REST, WATCHED = 1.0, 0.3  # s after a cancel or a push in which the pelvis comes to rest, and to watch it


# -- which goals it accepts -------------------------------------------------------------------------------------------


def _is_known(goal: Goal) -> bool | None:
    """Return whether odom and the loads had reached the server when the goal came; None: nobody can tell."""
    run = life.run_of(goal)
    if run.ground_truth:
        return True
    firsts = [run.published(topic)[:1] for topic in ("odom", "l_foot/wrench", "r_foot/wrench")]
    if not all(first and first[0].t < (goal.answer or goal.sent).t for first in firsts):
        return False
    return True if all(first[0].t < goal.sent.t - ON_ITS_WAY for first in firsts) else None


@obligation(1, 2, of=goals, see="06_walk_to_a_pose#reject-task")
def accepts(goal: Goal) -> str | None:
    """It accepts a goal for a robot that crouches or stands, also after others have ended"""
    if _is_known(goal) is not True or truth.lay_on_the_floor(goal):
        return None
    if any(life.overlaps(other, goal) is not False for other in life.others(goal)):
        return None
    run, stands = life.run_of(goal), truth.began_high(goal)
    for last in run.published("odom")[-1:] if goal.answer else ():
        expect(
            last.subscriptions > 0,
            expected="a subscription to odom",
            observed="the grader published it, and nobody was subscribed",
            help='create_subscription(Odometry, "odom", …), a relative name.',
            at=last.t,
        )
    deaf = (why_no_message_arrives(run, topic) for topic in ("odom", "robot_state"))
    later = any(result.t < goal.sent.t for result in run.all(ev.ResultReceived))
    help = advice.STANDS_ALREADY if stands else advice.FREE_AGAIN if later else advice.ACCEPT
    goal.require_accepted(next(filter(None, deaf), help))
    return f"{'standing' if stands else 'crouching'}, {'after another' if later else 'at first'}"


@obligation(1, of=goals, see="06_walk_to_a_pose#reject-task")
def rejects_the_unknown(goal: Goal) -> str | None:
    """It rejects a goal before the first messages of the robot"""
    if _is_known(goal) is not False:
        return None
    goal.require_rejected(because="no message of the robot has come yet", help=advice.UNKNOWN)
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
    """It SUCCEEDS, and base_link is then at 0.59 m or higher"""
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
        observed=f"it is at {height:.3f} m",
        help=advice.about_the_height(goal, height),
        at=result.t,
    )
    return "pushed" if truth.was_pushed(goal) else "undisturbed"


@obligation(5, 7, of=goals, see="10_parameters_and_balance#phases-why")
def rises_though_pushed(goal: Goal) -> str | None:
    """Pushed on its way, it rises all the same"""
    return succeeds.require(goal) if truth.was_pushed(goal) else None


@obligation(6, of=goals, see="10_parameters_and_balance#still-why")
def settles(goal: Goal) -> str | None:
    """When it SUCCEEDS base_link has been high, still and upright for 0.5 s"""
    if goal.status != SUCCEEDED or not goal.result:
        return None
    begin, end = (goal.result.t - before for before in SETTLED)
    for body in truth.bodies(life.run_of(goal), begin, end):
        expect(
            not body.unrest,
            expected=f"base_link at {RISEN} m, slower than 0.02 m/s and upright within 0.05 rad for 0.5 s before "
            "the goal SUCCEEDED",
            observed=f"{body.unrest} {goal.result.t - body.t:.1f} s before",
            help="Succeed only when height, speed and tilt, as odom measures them, have all been good for 0.5 s in a "
            "row.",
            at=body.t,
        )
    return "simulated" if goal.run.ground_truth else "played"


@obligation(2, of=goals, see="10_parameters_and_balance#phases-why")
def says_that_it_stands(goal: Goal) -> str | None:
    """A goal for a robot that stands is ABORTED at once, with ALREADY_STANDING"""
    if not life.accepted(goal) or not truth.began_high(goal) or life.interrupted(goal):
        return None
    result = goal.require_result(
        ABORTED, help="Nothing was done, so it is no success: abort() with ALREADY_STANDING."
    )
    require_error_code(goal, "ALREADY_STANDING", because="the robot stands already")
    _require_at_once(goal, result, "Compare odom's height with 0.59 m before the first phase.")
    return "after a rise" if life.others(goal) else "at first"


@obligation(15, of=goals, see="07_cancel_and_preempt#fall-why")
def ends_with_a_fall(goal: Goal) -> str | None:
    """When the robot falls the goal is ABORTED with FELL"""
    if not truth.began_low(goal) or life.granted(goal) or goal.status == SUCCEEDED:
        return None
    fallen = truth.fallen_during(goal)
    if fallen is None:
        return None
    require_fall_reported(goal, fallen)
    return "a fall"


@obligation(16, of=goals, see="07_cancel_and_preempt#fall-why")
def refuses_the_floor(goal: Goal) -> str | None:
    """A goal for a robot that has fallen is rejected, or ABORTED at once with FELL"""
    if not truth.lay_on_the_floor(goal):
        return None
    if not life.accepted(goal):
        goal.require_rejected(because="the robot has fallen", help=advice.FLOOR)
        return "rejected"
    result = goal.require_result(ABORTED, help=advice.FLOOR)
    require_error_code(goal, "FELL", because="the robot has fallen")
    _require_at_once(goal, result, advice.FLOOR)
    return "aborted"


@obligation(12, of=goals, see="07_cancel_and_preempt#m1-why")
def cancels(goal: Goal) -> str | None:
    """A cancel at any moment is agreed to, and the goal ends CANCELED"""
    over = life.ended_at(goal) if goal.status == SUCCEEDED else goal.run.end
    asked = [each for each in goal.cancels if goal.answer and goal.answer.t <= each.sent.t < over]
    if not asked or not truth.began_low(goal):
        return None
    asked[0].require_agreed(goal)
    took = goal.require_result(CANCELED).t - asked[0].sent.t
    expect(
        took <= CANCELING,
        expected=f"the goal to end CANCELED soon after the cancel ({CANCELING:g} s are forgiven)",
        observed=f"it ended {took:.1f} s after it",
        help="Look at is_cancel_requested in every phase, before you look whether the phase is over.",
        at=goal.result.t if goal.result else None,
    )
    return _phase_at(goal, asked[0].sent.t)


@obligation(14, of=goals, see="08_navigation#late-why")
def keeps_the_limit(goal: Goal) -> str | None:
    """A goal that has not succeeded within 12 s is ABORTED then, and not before"""
    if not truth.began_low(goal) or life.granted(goal) or truth.fallen_during(goal) or life.interrupted(goal):
        return None
    in_time = goal.status == SUCCEEDED and life.ended_at(goal) <= goal.accepted_at + TIME_LIMIT + LATE
    if in_time or life.was_not_awaited(goal):
        return None
    result = goal.require_result(ABORTED, help=advice.TIME_IS_UP)
    took = result.t - goal.accepted_at
    expect(
        TIME_LIMIT - EARLY <= took <= TIME_LIMIT + LATE,
        expected=f"the goal to be given up {TIME_LIMIT:g} s after it was accepted",
        observed=f"after {took:.1f} s",
        help="Remember once when the goal was accepted, and compare in every round and every phase."
        if took > TIME_LIMIT
        else why_rclpy_aborted(goal) or "Nothing else was wrong: let the goal go on until 12 s are over.",
        at=result.t,
    )
    return "held" if truth.was_held(goal) else "it could have risen"


@obligation(17, of=goals)
def names_no_error(goal: Goal) -> str | None:
    """The error_code is NONE, except for a robot that stands already or has fallen"""
    if not life.accepted(goal) or not goal.result or truth.began_high(goal):
        return None
    if truth.lay_on_the_floor(goal) or life.interrupted(goal) or truth.fallen_during(goal):
        return None
    require_error_code(goal, "NONE", because="the action has no code for this end")
    return name_of(GoalStatus, goal.result.status)


says_why_it_aborted = obligation(17, of=goals)(reporting.says_why_it_aborted)
status_in_order = obligation(12, of=goals)(ends.status_in_order)


# -- what the robot does ----------------------------------------------------------------------------------------------


@obligation(3, of=whole_run, see="01_robot_and_graph#walk-intro")
def rises_in_place(run: Transcript) -> str | None:
    """The robot rises without a step"""
    if not run.ground_truth or truth.pushes(run):
        return None  # a push may make it step
    for robot in run.ground_truth:
        expect(
            robot.mode != RobotState.WALKING,
            expected="the robot to rise on the spot",
            observed="it walks",
            help="Leave linear.x, linear.y and angular.z at 0: any of them makes the robot walk.",
            at=robot.t,
        )
    return "all the time"


@obligation(4, of=goals, see="10_parameters_and_balance#still-why")
def stays_down_while_uneven(goal: Goal) -> str | None:
    """It stays down until the loads have been even for 0.3 s in a row"""
    if not truth.began_low(goal):
        return None
    run, (at, end) = life.run_of(goal), truth.lifetime(goal)
    even = _first_even(goal, end)
    if even is None or even < at + LEANED:
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
        rose, when, how = bool(early), min(early, default=at), "it was told to rise"
    expect(
        not rose,
        expected="the pelvis to stay down until the loads have been even for 0.3 s",
        observed=f"{how}, with loads of {_loads_at(run, when)}",
        help="Subscribe to l_foot/wrench and r_foot/wrench: force.z is what a foot carries. Rise only when the smaller "
        "has been at least 0.8 of the larger for 0.3 s.",
        at=when,
    )
    return "leaned on" if run.ground_truth else "swaying"


def _first_even(goal: Goal, end: float) -> float | None:
    """Return until when (s) a goal's robot must stay down: they were never even for 0.3 s. None: unknown."""
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
    """Uneven loads while it rises or settles stop it, and it does not succeed before they are even again"""
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
            observed=f"it SUCCEEDED with loads of {_loads_at(run, even)}",
            help="Look at the loads in every phase, also in settling.",
            at=life.ended_at(goal),
        )
        if even - uneven < REACTION + 0.1:
            continue
        highest = max(truth.bodies(run, uneven + REACTION, even), key=lambda body: body.z)
        expect(
            before > RISEN - STOPPING or highest.z <= before + STOPPING,
            expected="the pelvis to stop while one foot carries much more than the other",
            observed=f"it rose from {before:.2f} to {highest.z:.2f} m, with loads of {_loads_at(run, highest.t)}",
            help="Look at the loads also while it rises: when the smaller is below 0.6 of the larger, publish a zero "
            "Twist and go back to shifting.",
            at=highest.t,
        )
        judged = "settling" if before >= RISEN - STOPPING else "rising"
    return judged


@obligation(9, of=goals)
def names_shifting(goal: Goal) -> str | None:
    """While the loads are uneven the phase is shifting"""
    if not truth.began_low(goal):
        return None
    run, judged = life.run_of(goal), 0
    for uneven, even in truth.uneven_spans(run, *truth.lifetime(goal), LEANED):
        for each in goal.feedback:
            if uneven + FEEDBACK_DELAY <= each.t <= even:
                judged += 1
                expect(
                    each.feedback.phase == SHIFTING,
                    expected="the phase shifting while the loads are uneven",
                    observed=f"{each.feedback.phase!r}, with loads of {_loads_at(run, each.t)}",
                    help="Let the loads choose the phase: shifting ends only after 0.3 s of even loads, and uneven "
                    "ones lead back to it, from settling, too.",
                    at=each.t,
                )
    return "uneven loads" if judged else None


@obligation(12, 14, of=goals, see="07_cancel_and_preempt#m12-robot-why")
def stays_where_it_ended(goal: Goal) -> str | None:
    """After the end, or a cancel, the pelvis stays at the height that it has reached"""
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
    begin = max([asked, *(last for first, last in disturbances if first <= asked)]) + AT_REST
    if end < begin + WATCHED:
        return None
    at = goal.run.robot_at(asked).z
    after = goal.run.robot_between(begin, end)
    lowest, highest = min(after, key=lambda robot: robot.z), max(after, key=lambda robot: robot.z)
    wrong = highest if highest.z > at + STOPPING else lowest
    expect(
        at - GAIN <= lowest.z and highest.z <= at + STOPPING,
        expected=f"the pelvis to stay at about {at:.2f} m, where it was at {asked:.1f} s",
        observed=f"it went to {wrong.z:.2f} m",
        help="Publish a zero Twist as soon as the goal is to end, and nothing else on cmd_vel afterwards. Without one "
        "the robot rises for 0.5 s more."
        if highest.z > at + STOPPING
        else "Do not crouch again: a zero Twist holds the height.",
        at=wrong.t,
    )
    expect(
        highest.z - lowest.z <= GAIN / 2,
        expected="the pelvis at rest 1 s after the end",
        observed=f"it moves between {lowest.z:.3f} and {highest.z:.3f} m",
        help="Publish nothing but zero on cmd_vel once the goal has ended: stop the timer or thread that does.",
        at=highest.t,
    )
    return name_of(GoalStatus, goal.result.status)


# -- what the feedback says -------------------------------------------------------------------------------------------


@obligation(8, of=goals, see="06_walk_to_a_pose#settle-intro")
def feedback_at_5_hz(goal: Goal) -> str | None:
    """Feedback comes at 5 Hz without a gap over 1 s"""
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
    """The phase is shifting, rising or settling, each while the robot does it"""
    feedback = _before_the_end(goal)
    undisturbed = goal.run.ground_truth and not truth.was_pushed(goal)
    for each in feedback:
        expect(
            each.feedback.phase in PHASES,
            expected="feedback.phase to be shifting, rising or settling",
            observed=f"{each.feedback.phase!r}",
            help="Use the task's words, letter by letter.",
            at=each.t,
        )
        if undisturbed:
            _require_seen_phase(goal, each)
    has_risen = goal.status == SUCCEEDED and undisturbed
    if feedback and has_risen and not truth.uneven_spans(life.run_of(goal), *truth.lifetime(goal), 0.0):
        seen = [phase for phase, _ in groupby(each.feedback.phase for each in feedback)]
        expect(
            seen in (list(PHASES), list(PHASES[1:])),
            expected="the phases shifting, rising, settling in the feedback, in this order",
            observed=", ".join(seen),
            help="Keep the phase in a variable, change it where a measurement ends it, and copy it to feedback.phase.",
            at=feedback[0].t,
        )
        return "in order"
    return "words" if feedback else None


def _require_seen_phase(goal: Goal, each: ev.FeedbackReceived) -> None:
    """Require that the robot rises in no other phase than rising, and settles where it is high enough."""
    run, phase = life.run_of(goal), each.feedback.phase
    recent = run.robot_between(each.t - FEEDBACK_DELAY / 2, each.t)
    highest = max(robot.z for robot in recent)
    rises = min(truth.climb(run, robot.t) for robot in recent) > 2 * CLIMBS and highest < RISEN - GAIN
    expect(
        phase == RISING or not rises,
        expected="the phase rising while the pelvis comes up",
        observed=f"{phase!r} at {recent[-1].z:.3f} m",
        help="Enter rising where you begin to publish linear.z, and settling where odom says 0.59 m.",
        at=each.t,
    )
    expect(
        phase != SETTLING or highest >= RISEN - GAIN,
        expected=f"the phase settling from {RISEN} m on",
        observed=f"it settles at {recent[-1].z:.3f} m",
        help="Enter settling when odom's height is 0.59 m, not after a time.",
        at=each.t,
    )


@obligation(10, of=goals, see="08_navigation#zero-why")
def measures_percent(goal: Goal) -> str | None:
    """percent_complete is the share of the height gained since the acceptance, and 100 at success"""
    feedback = _before_the_end(goal)
    if not feedback or not truth.began_low(goal) or truth.fallen_during(goal):
        return None
    run, start = life.run_of(goal), truth.height_at(life.run_of(goal), goal.accepted_at)
    for each in feedback:
        percent = float(each.feedback.percent_complete)
        recent = truth.bodies(run, max(goal.accepted_at - 0.1, each.t - AGE), each.t)
        true = [max(0.0, 100 * (body.z - start) / (STANCE - start)) for body in recent]
        near = 0.0 if truth.was_pushed(goal) else PERCENT_SLACK
        expect(
            0.0 <= percent <= 100.01 and (not near or min(true) - near <= percent <= max(true) + near),
            expected=f"percent_complete near {true[-1]:.0f}, the share of the height that the pelvis has gained",
            observed=f"{percent:.0f}",
            help="Measure it: 100 * (height - height at acceptance) / (0.60 - height at acceptance), from 0 to 100.",
            at=each.t,
        )
    if goal.status == SUCCEEDED:
        last = feedback[-1]
        expect(
            last.feedback.percent_complete >= COMPLETE,
            expected="100 percent in the last feedback of a goal that SUCCEEDED",
            observed=f"{last.feedback.percent_complete:.1f}",
            help="Publish one more feedback with percent_complete 100 before succeed().",
            at=last.t,
        )
    return f"from {math.floor(10 * start) / 10:.1f} m"


@obligation(11, of=goals, see="08_navigation#zero-why")
def never_loses_percent(goal: Goal) -> str | None:
    """percent_complete never falls, except where uneven loads lead back to shifting"""
    feedback = _before_the_end(goal)
    for before, after in pairwise(feedback):
        was, now = before.feedback.percent_complete, after.feedback.percent_complete
        expect(
            now >= was - 0.01 or after.feedback.phase == SHIFTING,
            expected="percent_complete never to fall, except back in shifting",
            observed=f"{now:.1f} after {was:.1f}, in {after.feedback.phase}",
            help="The pelvis bobs by some millimetres: publish the largest value so far, and begin anew only where you "
            "enter shifting.",
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
        expected="that answer within 2 s",
        observed=f"it came after {took:.1f} s",
        help=help,
        at=result.t,
    )


def _phase_at(goal: Goal, t: float) -> str:
    """Return in which phase the robot was by its height at a moment (s), for the table of clauses."""
    z, start = truth.height_at(life.run_of(goal), t), truth.height_at(life.run_of(goal), goal.accepted_at)
    return "shifting" if z < start + BEGUN else "settling" if z >= RISEN else "rising"


def _loads_at(run: Transcript, t: float) -> str:
    sample = min(truth.loads(run, t - 1.0, t + 1.0), key=lambda sample: abs(sample.t - t), default=None)
    return f"{sample.left:.0f} and {sample.right:.0f} N" if sample else "unknown"
