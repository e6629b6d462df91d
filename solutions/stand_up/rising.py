"""What the robot did while it rose, as the simulator has it, up to the success of its goal."""

from __future__ import annotations

import math

from autograder.authoring import events as ev
from autograder.authoring.connections import why_nothing_is_heard
from autograder.authoring.failure import Failure, expect
from autograder.authoring.goal import ABORTED, SUCCEEDED, Goal
from autograder.authoring.goal_endings import why_rclpy_aborted
from autograder.authoring.missing import unseen
from autograder.authoring.robot_record import RobotRecord
from autograder.authoring.walking.reports import require_error_code
from humanoid_interfaces.action import StandUp
from humanoid_interfaces.msg import RobotState

STANCE, RISEN, CROUCHED = 0.60, 0.59, 0.47  # m, heights of the pelvis
HEIGHT_SLACK = 0.005  # m
STILL, UPRIGHT = 0.035, 0.06  # m/s, rad; 0.02 and 0.05 are asked for
SETTLED = 0.40, 0.10  # s before the result, from when to when it must have been settled; 0.5 s are asked for
GAIN = 0.02  # m that a pelvis may still come up that should stay where it is
BEGUN = 0.006  # m, more than a pelvis bobs at rest
FROZEN = 10  # feedback messages; so many alike are no coincidence while the robot rises
TIME_LIMIT, EARLY, LATE = 12.0, 0.7, 2.5  # s

_ACCEPT = (
    "goal_callback must return GoalResponse.ACCEPT, also for a robot that stands already (True is not "
    "GoalResponse.ACCEPT)."
)
_FREE_AGAIN = "A goal before it has ended: in a finally block, remember that the robot is free again."
_CALM = (
    "Succeed only when height, speed and tilt, as odom measures them, have all been good for 0.5 s in a row."
)


def require_accepted(goal: Goal, help: str = "") -> Goal:
    """Require that the server accepted the goal."""
    deaf = (why_nothing_is_heard(goal.run, topic) for topic in ("odom", "robot_state"))
    later = any(result.t < goal.sent.t for result in goal.run.all(ev.ResultReceived))
    return goal.require_accepted(next(filter(None, deaf), help or (_FREE_AGAIN if later else _ACCEPT)))


def require_crouch(goal: Goal) -> float:
    """Return when (s) the goal was accepted; the robot must have crouched then."""
    at = require_accepted(goal).accepted_at
    if goal.run.robot_at(goal.sent.t).z > RISEN - 0.01:
        raise unseen(goal.run, f"the robot did not crouch at “{goal.name}”")
    return at


def require_low(goal: Goal, height: float) -> None:
    """Require that the robot crouched at about a height (m) when the goal came."""
    require_accepted(goal)
    if abs(goal.run.robot_at(goal.sent.t).z - height) > 0.03:
        raise unseen(goal.run, f"the robot did not crouch at {height:.2f} m")


def require_success(goal: Goal) -> ev.ResultReceived:
    """Return the result of a goal, which must have succeeded; if it was aborted, its code says what to do."""
    require_accepted(goal)
    result = goal.result
    if result is not None and result.status == ABORTED and not why_rclpy_aborted(goal):
        raise Failure(
            expected="status SUCCEEDED",
            observed=f"status ABORTED, error_code {result.result.error_code}: {result.result.error_msg[:200]!r}",
            help=_why_blind(goal) or _what_to_do_about_an_abort(goal, result),
            at=result.t,
        )
    return goal.require_result(SUCCEEDED)


def _why_blind(goal: Goal) -> str | None:
    """Return what to do if what the goal reports never changed, though the robot rose."""
    seen = [robot.z for robot in goal.run.ground_truth if robot.t >= goal.accepted_at] or _played_heights(
        goal
    )
    percents = {feedback.feedback.percent_complete for feedback in goal.feedback}
    if not seen or len(goal.feedback) < FROZEN or len(percents) > 1 or max(seen) < seen[0] + 0.05:
        return None
    return (
        f"percent_complete stayed {percents.pop():.0f} in all {len(goal.feedback)} feedback messages, though the robot "
        "rose: no message of odom is served while execute holds the only thread. Use MultiThreadedExecutor, or an "
        "async execute that awaits."
    )


def _played_heights(goal: Goal) -> list[float]:
    """Return the heights of the pelvis (m) that the scenario published for this goal, if it played the robot."""
    published = [each for each in goal.run.all(ev.MessagePublished) if each.t >= goal.accepted_at]
    return [each.message.pose.pose.position.z for each in published if each.topic == "odom"]


def _what_to_do_about_an_abort(goal: Goal, result: ev.ResultReceived) -> str:
    code, run = result.result.error_code, goal.run
    height = run.robot_at(result.t).z if run.ground_truth else None
    if code == StandUp.Result.ALREADY_STANDING:
        return "A crouching robot is on its feet, so robot_state.mode is STANDING: compare odom's height with 0.59 m."
    if code == StandUp.Result.FELL:
        return "It had not fallen. A push is no fall: abort with FELL when robot_state.mode is FALLEN, and not before."
    if result.t - goal.accepted_at > TIME_LIMIT - EARLY:
        where = "" if height is None else f", with the pelvis at {height:.2f} m"
        return (
            f"The time limit ended it{where}. Publish cmd_vel in every round, as it holds for 0.5 s only, and look at "
            "what ends the phase that it was in."
        )
    return "Nothing was wrong with the robot: let it shift its weight and go on, up to the time limit."


def require_risen(goal: Goal) -> ev.ResultReceived:
    """Require that the goal succeeded, and the crouching robot had risen by then."""
    require_crouch(goal)
    result = require_success(goal)
    height = goal.run.robot_at(result.t).z
    expect(
        height >= RISEN - HEIGHT_SLACK,
        expected=f"base_link at {RISEN} m or higher when the goal SUCCEEDED",
        observed=f"it is at {height:.3f} m in the simulator",
        help=_what_to_do_about_the_height(goal, height),
        at=result.t,
    )
    require_error_code(goal, "NONE", because="the robot has risen")
    return result


def _what_to_do_about_the_height(goal: Goal, height: float) -> str:
    if height < goal.run.robot_at(goal.accepted_at).z + GAIN:
        return "It never rose: publish a Twist with linear.z above 0 on cmd_vel, again and again, at least every 0.5 s."
    return "Look at odom's pose.pose.position.z, and let the loop go on until it is 0.59 m."


def require_on_the_spot(goal: Goal) -> None:
    """Require that the robot took no step until the goal succeeded."""
    begin, result = require_crouch(goal), require_risen(goal)
    for robot in goal.run.robot_between(begin, result.t):
        expect(
            robot.mode == RobotState.STANDING,
            expected="the robot to rise on the spot",
            observed="it walks",
            help="Leave linear.x, linear.y and angular.z at 0: any of them makes the robot walk.",
            at=robot.t,
        )


def require_settled(goal: Goal) -> None:
    """Require that the robot was high, still and upright for a while before the goal succeeded."""
    result = require_risen(goal)
    begin, end = (result.t - before for before in SETTLED)
    for robot in goal.run.robot_between(begin, end):
        speed = math.hypot(robot.speed, climb(goal.run, robot.t))
        tilt = math.acos(max(-1.0, min(1.0, robot.up)))
        for is_good, what in (
            (robot.z >= RISEN - HEIGHT_SLACK, f"it is at {robot.z:.3f} m"),
            (speed < STILL, f"it moves at {speed:.2f} m/s"),
            (tilt < UPRIGHT, f"it leans by {tilt:.2f} rad"),
        ):
            expect(
                is_good,
                expected=f"base_link at {RISEN} m, slower than 0.02 m/s and upright within 0.05 rad for 0.5 s before "
                "the goal SUCCEEDED",
                observed=f"{what} {result.t - robot.t:.1f} s before",
                help=_CALM,
                at=robot.t,
            )


def climb(run: RobotRecord, t: float) -> float:
    """Return how fast (m/s) the pelvis rose around a time (s)."""
    earlier, later = run.robot_at(t - 0.06), run.robot_at(t + 0.06)
    return (later.z - earlier.z) / max(later.t - earlier.t, 0.02)


def require_begun(goal: Goal, at: float) -> None:
    """Require that by a moment (s) the robot had begun to rise for a goal."""
    start, height = goal.run.robot_at(require_crouch(goal)).z, goal.run.robot_at(at).z
    expect(
        height > start + BEGUN,
        expected="the robot rising by then",
        observed=f"its pelvis is at {height:.2f} m, as at the acceptance",
        help=why_rclpy_aborted(goal)
        or "Publish linear.z above 0 on cmd_vel in every round of the rise: the robot stops by itself 0.5 s after "
        "the last one.",
        at=at,
    )
