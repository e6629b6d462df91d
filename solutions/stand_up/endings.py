"""How goals end that do not succeed, and that the robot stays as it was then."""

from __future__ import annotations

from autograder.authoring.failure import Failure, expect
from autograder.authoring.falls import require_fell_told, require_knocked_over
from autograder.authoring.goal import ABORTED, SUCCEEDED, Goal
from autograder.authoring.goal_endings import why_rclpy_aborted
from autograder.authoring.missing import unseen
from autograder.authoring.walking.reports import require_error_code
from humanoid_interfaces.msg import RobotState

from .leaning import STOPPING
from .rising import (
    CROUCHED,
    EARLY,
    GAIN,
    LATE,
    RISEN,
    TIME_LIMIT,
    require_accepted,
    require_begun,
    require_crouch,
    require_risen,
)

AT_ONCE = 2.5  # s


def require_standing_told(goal: Goal) -> None:
    """Require that a goal for a robot that stands is accepted, and soon ABORTED with ALREADY_STANDING."""
    require_accepted(
        goal,
        help="A rejection carries no reason, so the client would never learn why: accept the goal, and abort it with "
        "ALREADY_STANDING.",
    )
    before = goal.run.robot_at(goal.sent.t)
    if before.mode != RobotState.STANDING or before.z < RISEN:
        raise unseen(goal.run, f"the robot did not stand at “{goal.name}”")
    result = goal.require_result(
        ABORTED, help="Nothing was done, so it is no success: abort() with ALREADY_STANDING."
    )
    require_error_code(goal, "ALREADY_STANDING", because="the robot stands already")
    goal.require_reason()
    took = result.t - goal.accepted_at
    expect(
        took <= AT_ONCE,
        expected=f"that answer within {AT_ONCE:g} s",
        observed=f"it came after {took:.1f} s",
        help="Compare odom's height with 0.59 m before the first phase.",
        at=result.t,
    )


def require_given_up(goal: Goal, since: float) -> None:
    """Require that the goal was ABORTED 12 s after `since` (s) without a code, but with words."""
    result = goal.require_result(
        ABORTED, help="12 s are over: publish a zero Twist, and abort() with a sentence in error_msg."
    )
    took = result.t - since
    expect(
        TIME_LIMIT - EARLY <= took <= TIME_LIMIT + LATE,
        expected=f"the goal to be given up {TIME_LIMIT:g} s after it was accepted",
        observed=f"after {took:.1f} s",
        help="Remember once when the goal was accepted, and compare in every round and every phase."
        if took > TIME_LIMIT
        else why_rclpy_aborted(goal) or "Nothing else was wrong: let the goal go on until 12 s are over.",
        at=result.t,
    )
    require_error_code(goal, "NONE", because="the action has no code for the time limit")
    goal.require_reason()


def require_held(goal: Goal) -> None:
    """Require that the robot was kept from rising until the goal ended."""
    run = goal.run
    begin = require_crouch(goal)
    run.told("take_over", before=begin, velocity=[0.0, 0.0, 0.0])
    end = run.told("take_over", velocity=None).t
    if max(robot.z for robot in run.robot_between(begin, end)) > CROUCHED:
        raise unseen(run, "the robot rose although it was held")


def require_no_rise_afterwards(goal: Goal) -> None:
    """Require that a robot that is let go after the time limit stays down."""
    run = goal.run
    require_held(goal)
    if goal.result is None:
        goal.require_result(ABORTED)
    given = run.told("take_over", velocity=None)
    highest = max(run.robot_between(given.t, run.end), key=lambda robot: robot.z)
    expect(
        highest.z <= CROUCHED,
        expected="the robot to stay down: the goal has ended",
        observed=f"it rose to {highest.z:.2f} m, {highest.t - given.t:.1f} s after it was let go",
        help="Publish nothing but zero on cmd_vel once the goal has ended: stop the timer or thread that does.",
        at=highest.t,
    )


def require_stayed(goal: Goal) -> None:
    """Require that a cancel while the robot rose left the pelvis at the height it had reached."""
    run = goal.run
    require_crouch(goal)
    asked = goal.requests_to_cancel[-1].sent.t
    at = run.robot_at(asked)
    require_begun(goal, asked)
    after = run.robot_between(asked + 1.0, asked + 3.0)
    lowest, highest = min(robot.z for robot in after), max(robot.z for robot in after)
    expect(
        at.z - GAIN <= lowest and highest <= at.z + STOPPING,
        expected=f"the pelvis to stay at about {at.z:.2f} m, where it was when the cancel came",
        observed=f"it went to {highest if highest > at.z + STOPPING else lowest:.2f} m",
        help="Publish a zero Twist as soon as the cancel is seen. Without one the robot rises for 0.5 s more."
        if highest > at.z + STOPPING
        else "Do not crouch again: a zero Twist holds the height.",
        at=asked + 1.0,
    )
    expect(
        highest - lowest <= GAIN / 2,
        expected="the pelvis at rest 1 s after the cancel",
        observed=f"it moves between {lowest:.3f} and {highest:.3f} m",
        help="Publish nothing but zero on cmd_vel after the cancel.",
        at=asked + 1.0,
    )


def require_stayed_down(goal: Goal, since: float, gain: float) -> None:
    """Require that the pelvis did not come up by more than `gain` (m) within 3 s of a moment (s)."""
    start = goal.run.robot_at(since)
    highest = max(goal.run.robot_between(since, since + 3.0), key=lambda robot: robot.z)
    expect(
        highest.z <= start.z + gain,
        expected="the robot to stay down: the goal was cancelled",
        observed=f"it rose from {start.z:.2f} to {highest.z:.2f} m",
        help="Look at is_cancel_requested in every phase, before you look whether the phase is over.",
        at=highest.t,
    )


def require_aborted_by_a_fall(goal: Goal) -> None:
    """Require that the goal went on until the robot fell, and was then ABORTED with FELL."""
    run = goal.run
    require_crouch(goal)
    require_begun(goal, run.told("push").t)
    require_fell_told(goal, require_knocked_over(run))
    goal.require_reason()


def require_hopeless(goal: Goal) -> None:
    """Require that a goal for a fallen robot is rejected, or soon ABORTED with FELL."""
    if require_knocked_over(goal.run).t > goal.sent.t:
        raise unseen(goal.run, "the robot fell only after the goal")
    if goal.answer is not None and not goal.answer.accepted:
        return
    at = goal.require_accepted().accepted_at
    help = "It cannot get up from a fall: reject the goal while robot_state.mode is FALLEN, or abort it with FELL."
    result = goal.require_result(ABORTED, help=help)
    require_error_code(goal, "FELL", because="the robot has fallen")
    if result.t > at + AT_ONCE:
        raise Failure(
            expected="the goal rejected, or ABORTED at once",
            observed=f"it ended after {result.t - at:.1f} s",
            help=help,
            at=result.t,
        )


def require_rejected_while_busy(first: Goal, second: Goal) -> None:
    """Require that a goal is rejected while another runs, which then succeeds."""
    require_crouch(first)
    require_begun(first, second.sent.t)
    if first.result is not None and first.result.t < second.sent.t:
        first.require_result(SUCCEEDED)
        raise unseen(first.run, "the first goal had ended when the second came")
    second.require_rejected(
        because="the robot is already rising for another goal",
        help="Remember in goal_callback that a goal runs, forget it when execute ends, and reject meanwhile: rclpy "
        "runs the goals it accepts side by side.",
    )
    require_risen(first)
