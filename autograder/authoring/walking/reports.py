"""Compares what the server reports about the robot, in feedback and results, with what the robot did."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geometry_msgs.msg import PoseStamped

from autograder.authoring.diagnosis.goal_diagnosis import why_rclpy_aborted, why_starved
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.goal import ABORTED, Goal
from autograder.authoring.evidence.robot_topic import DELIVERY
from autograder.authoring.failure import expect
from autograder.authoring.walking.life import ended_at
from autograder.authoring.walking.planar import error, heading, target, turn
from humanoid_interfaces.msg import RobotState

REPORT_SLACK = 0.08  # m or rad, in addition to the motion while the message was made and delivered
REPORT_AGE = 0.6  # s that a reported pose may be old: odom's period, the feedback's period, delivery
FINAL_AGE = 0.5  # s that final_pose may be older than the end of a goal for which the robot stops
FINAL_SLACK = 0.015  # m by which final_pose may be off: odom's period, and rounding to centimetres
TRUTH_DELAY = 0.5  # s by which the ground truth may come after a report of it
HEIGHT_SLACK = 0.1  # m, more than the pelvis bobs while a message is made and delivered
UNIT_SLACK = 0.02  # by which the length of a reported quaternion may differ from 1
TAKEOVER_TIME = 2.0  # s in which a goal that preempts another may begin


def require_true_feedback(goal: Goal) -> None:
    """Require that pose, distance and steps, if it has them, in the feedback are the robot's at about that time.

    Feedback that comes after the result is not judged here.
    """
    steps = 0
    for feedback in goal.feedback:
        if goal.result and feedback.t > goal.result.t:
            return
        message = feedback.feedback
        _require_true_place(goal, feedback, _recent(goal, feedback.t))
        if not hasattr(message, "steps_taken"):
            continue
        now = _recent(goal, feedback.t, DELIVERY)
        _require_true_steps(goal, message.steps_taken, "feedback.steps_taken", feedback.t, now)
        expect(
            message.steps_taken >= steps,
            expected="steps_taken never to decrease",
            observed=f"{message.steps_taken} after {steps}",
            help="Publish feedback from one place, in order.",
            at=feedback.t,
        )
        steps = message.steps_taken


def _require_true_place(goal: Goal, feedback: ev.FeedbackReceived, recent: Sequence[ev.RobotTruth]) -> None:
    message = feedback.feedback
    require_true_pose(
        message.current_pose, recent, "feedback.current_pose", feedback.t, help=why_starved(goal)
    )
    distances = [error(robot, goal)[0] for robot in recent]
    claimed = message.distance_remaining
    expect(
        min(distances) - REPORT_SLACK <= claimed <= max(distances) + REPORT_SLACK,
        expected=f"feedback.distance_remaining near {distances[-1]:.2f} m",
        observed=f"{claimed:.2f} m",
        help="It is the straight distance in x and y (m) from odom's pose to the goal.",
        at=feedback.t,
    )


def require_true_result(goal: Goal) -> None:
    """Require that final_pose and total_steps were measured when the goal ended, and not copied from the request."""
    end = goal.result
    assert end, "call require_result first"
    age = DELIVERY if goal.status == ABORTED else end.t - ended_at(goal) + FINAL_AGE
    stamped, recent = end.result.final_pose, _recent(goal, end.t, age)
    _require_true_steps(goal, end.result.total_steps, "result.total_steps", end.t, recent)
    position, aim = stamped.pose.position, target(goal).position
    help = why_rclpy_aborted(goal)
    if not help and (position.x, position.y) == (aim.x, aim.y):
        help = "This is the pose that the goal asked for: fill in where the robot really stands, from odom."
    lying = any(robot.mode == RobotState.FALLEN for robot in recent)
    require_true_pose(
        *(stamped, recent, "result.final_pose", end.t, help),
        slack=FINAL_SLACK,
        turn_slack=math.pi if lying else 3 * FINAL_SLACK,
    )


def require_error_code(goal: Goal, name: str, *, because: str, help: str = "") -> None:
    """Require that the result names the reason; `help` is what to do if it names another one."""
    assert goal.result, "call require_result first"
    result = type(goal.result.result)
    constant = f"{result.__name__.replace('_', '.')}.{name}"  # such as WalkTo.Result.FELL
    if not help or goal.result.result.error_code == 0:
        help = f"Set result.error_code = {constant} before the terminal call, and return that same result."
    help = why_rclpy_aborted(goal) or help
    goal.expect("error_code", getattr(result, name), because=f"{because}: {name}", help=help)


def require_true_pose(
    stamped: PoseStamped,
    recent: Sequence[ev.RobotTruth],
    what: str,
    at: float,
    help: str | None = None,
    slack: float = REPORT_SLACK,
    turn_slack: float = 2 * REPORT_SLACK,
) -> None:
    """Require that a reported pose, in frame odom, is that of one of the simulator's `recent` samples.

    It may be off by `slack` (m) and `turn_slack` (rad).
    """
    position, frame = stamped.pose.position, stamped.header.frame_id.lstrip("/")
    expect(
        frame in ("odom", ""),
        expected=f"{what} in frame odom",
        observed=f"frame {frame!r}",
        help="Copy odom's header.frame_id together with its pose.",
        at=at,
    )
    off = min(math.hypot(position.x - robot.x, position.y - robot.y) for robot in recent)
    expect(
        off <= slack,
        expected=f"{what} where base_link is, x {recent[-1].x:.3f}, y {recent[-1].y:.3f} m ({slack:g} m are forgiven)",
        observed=f"x {position.x:.3f}, y {position.y:.3f} m",
        help=help
        or f"Fill {what} from the latest odom message before it is sent; the terminal call sends nothing that "
        "is set after it.",
        at=at,
    )
    height = min(recent, key=lambda robot: abs(robot.z - position.z)).z
    expect(
        position.z == 0.0 or abs(position.z - height) <= HEIGHT_SLACK,
        expected=f"{what} with z {height:.2f} m, where base_link is, or 0 as on a map",
        observed=f"z {position.z:.2f} m",
        help=help or "Copy the whole position of odom's pose.",
        at=at,
    )
    length = math.hypot(*(getattr(stamped.pose.orientation, axis) for axis in "xyzw"))
    expect(
        abs(length - 1.0) <= UNIT_SLACK,
        expected=f"{what} with an orientation of length 1",
        observed=f"{length:.2f}",
        help=help or "Copy the whole orientation of odom's pose: x, y, z and w.",
        at=at,
    )
    expect(
        min(turn(robot, stamped.pose.orientation) for robot in recent) <= turn_slack,
        expected=f"{what} with yaw {recent[-1].yaw:.2f} rad",
        observed=f"{heading(stamped.pose.orientation):.2f} rad",
        help=help or "Copy the whole orientation of odom's pose: x, y, z and w.",
        at=at,
    )


def _require_true_steps(goal: Goal, claimed: int, what: str, at: float, now: Sequence[ev.RobotTruth]) -> None:
    """Require the steps since the goal began: robot_state.steps of a moment ago minus those at the beginning."""
    before = goal.run.robot_at(goal.sent.t)
    # A robot that stands takes no step until the goal moves it; one that walks may take some before the goal begins.
    was_walking = before.mode == RobotState.WALKING
    latest = goal.run.robot_at(goal.accepted_at + TAKEOVER_TIME) if was_walking else before
    earliest = goal.run.robot_at(goal.sent.t - DELIVERY)
    least, most = max(0, now[0].steps - latest.steps), now[-1].steps - earliest.steps
    since_reset = claimed == now[-1].steps and before.steps > 0
    expect(
        least <= claimed <= most,
        expected=f"{what}: {least}" + (f" to {most}" if most > least else "") + ", for this goal",
        observed=f"{claimed}" + (", the steps since the robot was reset" if since_reset else ""),
        help="Take robot_state.steps, and subtract its value at the time when this goal was accepted.",
        at=at,
    )


def _recent(goal: Goal, t: float, age: float = REPORT_AGE) -> Sequence[ev.RobotTruth]:
    """Return the samples that a report at time `t` (s) may be based on: at most `age` s old."""
    return goal.run.robot_between(t - age, min(t + TRUTH_DELAY, goal.run.ground_truth[-1].t))
