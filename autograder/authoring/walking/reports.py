"""Compares what the server reports about the robot, in feedback and results, with what the robot did."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geometry_msgs.msg import PoseStamped

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.feedback import end_of_feedback, require_feedback
from autograder.authoring.goal import SUCCEEDED, Goal
from autograder.authoring.goal_endings import why_blind, why_rclpy_aborted
from autograder.authoring.walking.planar import error, heading, turn

REPORT_SLACK = 0.08  # m or rad, over what the robot moved while the message was made and delivered
REPORT_AGE = 0.6  # s that a reported pose may be old: odom's period, the feedback's period, delivery
STEP_SLACK = 3  # footsteps between robot_state's rate and the moment of the report


def require_true_feedback(goal: Goal) -> None:
    """Require that pose, distance and steps in the feedback are those of the robot at about that time."""
    require_feedback(goal)
    end_of_feedback(goal)  # until then it has to be true
    start = goal.run.robot_at(goal.sent.t).steps
    steps = 0
    for feedback in goal.feedback:
        message = feedback.feedback
        recent = _recent(goal, feedback.t)
        _require_true_place(goal, feedback, recent)
        _require_true_steps(message.steps_taken, start, recent, "feedback.steps_taken", feedback.t)
        expect(
            message.steps_taken >= steps,
            expected="steps_taken never to go back",
            observed=f"{message.steps_taken} after {steps}",
            help="Publish feedback from one place, in order.",
            at=feedback.t,
        )
        steps = message.steps_taken


def require_true_places(goal: Goal) -> None:
    """Require that pose and distance in the feedback are those of the robot at about that time."""
    require_feedback(goal)
    end_of_feedback(goal)  # until then it has to be true
    for feedback in goal.feedback:
        _require_true_place(goal, feedback, _recent(goal, feedback.t))


def _require_true_place(goal: Goal, feedback: ev.FeedbackReceived, recent: Sequence[ev.RobotTruth]) -> None:
    message = feedback.feedback
    require_true_pose(message.current_pose, recent, "feedback.current_pose", feedback.t, help=why_blind(goal))
    distances = [error(robot, goal)[0] for robot in recent]
    claimed = message.distance_remaining
    expect(
        min(distances) - REPORT_SLACK <= claimed <= max(distances) + REPORT_SLACK,
        expected=f"feedback.distance_remaining near {distances[-1]:.2f} m",
        observed=f"{claimed:.2f} m",
        help="It is the straight distance in x and y (m) from odom's pose to the goal.",
        at=feedback.t,
    )


def require_filled_result(goal: Goal) -> None:
    """Require that the result holds the pose and steps of the robot at the end."""
    end = goal.require_accepted().require_result(SUCCEEDED)
    recent, result = _recent(goal, end.t), end.result
    require_true_pose(result.final_pose, recent, "result.final_pose", end.t)
    start = goal.run.robot_at(goal.sent.t).steps
    _require_true_steps(result.total_steps, start, recent, "result.total_steps", end.t)
    require_error_code(goal, "NONE", because="the robot has arrived")


def require_error_code(goal: Goal, name: str, *, because: str) -> None:
    """Require that the result names the reason."""
    assert goal.result, "ask for its result first"
    result = type(goal.result.result)
    constant = f"{result.__name__.replace('_', '.')}.{name}"  # such as WalkTo.Result.FELL
    goal.expect(
        "error_code",
        getattr(result, name),
        because=f"{because}: {name}",
        help=why_rclpy_aborted(goal)
        or f"Set result.error_code = {constant} before the terminal call, and return that same result.",
    )


def require_true_pose(
    stamped: PoseStamped, recent: Sequence[ev.RobotTruth], what: str, at: float, help: str | None = None
) -> None:
    """Require that a reported pose is where the simulated robot was within the last moments, in frame odom."""
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
        off <= REPORT_SLACK,
        expected=f"{what} near x {recent[-1].x:.2f}, y {recent[-1].y:.2f} m",
        observed=f"x {position.x:.2f}, y {position.y:.2f} m",
        help=help
        or f"Fill {what} from the latest odom message before it is sent; the terminal call sends nothing that "
        "is set after it.",
        at=at,
    )
    expect(
        min(turn(robot, stamped.pose.orientation) for robot in recent) <= 2 * REPORT_SLACK,
        expected=f"{what} with yaw {recent[-1].yaw:.2f} rad",
        observed=f"{heading(stamped.pose.orientation):.2f} rad",
        help="Copy the whole orientation of odom's pose: x, y, z and w.",
        at=at,
    )


def _require_true_steps(
    claimed: int, start: int, recent: Sequence[ev.RobotTruth], what: str, at: float
) -> None:
    """Require true steps, which may be counted from the goal's start or from the robot's."""
    least = recent[0].steps - start - STEP_SLACK
    most = recent[-1].steps + STEP_SLACK
    expect(
        least <= claimed <= most,
        expected=f"{what} about {recent[-1].steps - start}",
        observed=f"{claimed}",
        help="Take robot_state.steps, and subtract its value at the time the goal was accepted.",
        at=at,
    )


def _recent(goal: Goal, t: float) -> Sequence[ev.RobotTruth]:
    return goal.run.robot_between(t - REPORT_AGE, t)
