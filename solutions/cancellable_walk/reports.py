"""What the server says about the robot, in feedback and results, compared with what the robot did."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from autograder.authoring import events as ev
from autograder.authoring.checks import expect
from autograder.authoring.missing import Missing, unseen
from autograder.authoring.transcript import GoalHistory, Transcript

from .goals import (
    SUCCEEDED,
    require_accepted,
    require_error_code,
    require_result,
)
from .planar import error, wrap, yaw

MIN_RATE, MAX_RATE = 3.0, 10.0  # Hz
MAX_GAP = 1.0  # s
REPORT_SLACK = 0.08  # m or rad, over what the robot moved while the message was made and delivered
REPORT_AGE = 0.6  # s a reported pose may be old: odom's period, the feedback's period, delivery
STEP_SLACK = 3  # footsteps between robot_state's rate and the moment of the report
LISTENED = 1.0  # s after a result in which no feedback may come
ARRIVING = 0.5  # s more that the last message may be older than the result
RATE_SLACK = 0.5  # Hz of measuring error over a short walk


def require_good_feedback_rate(run: Transcript, name: str) -> None:
    """Feedback came at 3-10 Hz on average without a gap over 1 s, from the answer to the result."""
    goal = require_accepted(run, name)
    times = [feedback.t for feedback in goal.feedback if goal.result is None or feedback.t <= goal.result.t]
    expect(
        len(times) >= 3,
        expected="feedback about five times a second while the robot walks",
        observed=f"{len(times)} message(s)",
        help="Call goal_handle.publish_feedback(feedback) with a WalkTo.Feedback in the loop of execute.",
        at=goal.answer.t if goal.answer else None,
    )
    rate = (len(times) - 1) / max(times[-1] - times[0], 1e-6)
    expect(
        MIN_RATE - RATE_SLACK <= rate <= MAX_RATE + RATE_SLACK,
        expected=f"feedback at 5 Hz ({MIN_RATE:.0f} to {MAX_RATE:.0f} Hz on average)",
        observed=f"{rate:.1f} Hz",
        help="Publish every 0.2 s: a loop with time.sleep(0.05) publishes in every fourth round.",
        at=times[0],
    )
    start = goal.answer.t if goal.answer else goal.sent.t
    _require_no_gap([start, *times], MAX_GAP)
    _require_no_gap([times[-1], _end(run, goal)], MAX_GAP + ARRIVING)


def _require_no_gap(times: Sequence[float], longest: float) -> None:
    gap, at = max((later - earlier, earlier) for earlier, later in pairwise(times))
    expect(
        gap <= longest,
        expected=f"no gap over {MAX_GAP:.0f} s in the feedback",
        observed=f"a gap of {gap:.1f} s",
        help="Something in the loop waits: publish feedback also while the robot turns, slows down or settles.",
        at=at,
    )


def _end(run: Transcript, goal: GoalHistory) -> float:
    """When (s) feedback may end: at the result; with the last message where the scenario saw that none comes."""
    if goal.result:
        return goal.result.t
    given_up = any((event.what, event.id) == ("result", goal.name) for event in run.all(ev.Unanswered))
    if given_up and goal.feedback:
        return goal.feedback[-1].t
    raise Missing(
        run, expected=f"feedback until the goal “{goal.name}” ends", never="nobody waited for its end"
    )


def require_feedback(run: Transcript, name: str) -> GoalHistory:
    """The goal was accepted, and there was feedback on it."""
    goal = require_accepted(run, name)
    expect(
        len(goal.feedback) > 0,
        expected="feedback",
        observed="none",
        help="Publish feedback while the robot walks.",
    )
    return goal


def require_true_feedback(run: Transcript, name: str) -> None:
    """Pose, distance and steps in the feedback are those of the robot at about that time."""
    goal = require_feedback(run, name)
    _end(run, goal)  # until then it has to be true
    start = run.robot_at(goal.sent.t).steps
    steps = 0
    for feedback in goal.feedback:
        message = feedback.feedback
        recent = _recent(run, feedback.t)
        require_true_pose(message["current_pose"], recent, "feedback.current_pose", feedback.t)
        distances = [error(robot, goal)[0] for robot in recent]
        claimed = message["distance_remaining"]
        expect(
            min(distances) - REPORT_SLACK <= claimed <= max(distances) + REPORT_SLACK,
            expected=f"feedback.distance_remaining near {distances[-1]:.2f} m",
            observed=f"{claimed:.2f} m",
            help="It is the straight distance in x and y (m) from odom's pose to the goal.",
            at=feedback.t,
        )
        _require_true_steps(message["steps_taken"], start, recent, "feedback.steps_taken", feedback.t)
        expect(
            message["steps_taken"] >= steps,
            expected="steps_taken never to go back",
            observed=f"{message['steps_taken']} after {steps}",
            help="Publish feedback from one place, in order.",
            at=feedback.t,
        )
        steps = message["steps_taken"]


def require_silence_after_the_end(run: Transcript, name: str) -> None:
    """No feedback came after the result, and the scenario watched for some."""
    goal = run.goal(name)
    result = goal.result
    if result is None or run.end < result.t + LISTENED:
        raise unseen(run, f"nobody listened for feedback after the result of “{name}”")
    late = [feedback for feedback in goal.feedback if feedback.t > result.t + 0.3]
    expect(
        not late,
        expected="no feedback after the result",
        observed=f"{len(late)} message(s), the last {late[-1].t - result.t:.1f} s after it" if late else "",
        help="Stop the timer or thread that publishes feedback before the terminal call.",
        at=late[0].t if late else None,
    )


def require_filled_result(run: Transcript, name: str) -> None:
    """The result holds the pose and steps of the robot at the end."""
    goal = require_accepted(run, name)
    result = require_result(run, goal, SUCCEEDED)
    recent = _recent(run, result.t)
    require_true_pose(result.result["final_pose"], recent, "result.final_pose", result.t)
    start = run.robot_at(goal.sent.t).steps
    _require_true_steps(result.result["total_steps"], start, recent, "result.total_steps", result.t)
    require_error_code(result, 0, "NONE")


def require_true_pose(stamped: dict[str, Any], recent: Sequence[ev.RobotTruth], what: str, at: float) -> None:
    """A reported pose is where the simulated robot was within the last moments, in frame odom."""
    position, orientation = stamped["pose"]["position"], stamped["pose"]["orientation"]
    frame = stamped["header"]["frame_id"].lstrip("/")
    expect(
        frame in ("odom", ""),
        expected=f"{what} in frame odom",
        observed=f"frame {frame!r}",
        help="Copy odom's header.frame_id together with its pose.",
        at=at,
    )
    off = min(math.hypot(position["x"] - robot.x, position["y"] - robot.y) for robot in recent)
    expect(
        off <= REPORT_SLACK,
        expected=f"{what} near x {recent[-1].x:.2f}, y {recent[-1].y:.2f} m",
        observed=f"x {position['x']:.2f}, y {position['y']:.2f} m",
        help=f"Fill {what} from the latest odom message before it is sent; the terminal call sends nothing that "
        "is set after it.",
        at=at,
    )
    heading = yaw(orientation)
    turn = min(abs(wrap(heading - robot.yaw)) for robot in recent)
    expect(
        turn <= 2 * REPORT_SLACK,
        expected=f"{what} with yaw {recent[-1].yaw:.2f} rad",
        observed=f"{heading:.2f} rad",
        help="Copy the whole orientation of odom's pose: x, y, z and w.",
        at=at,
    )


def _require_true_steps(
    claimed: int, start: int, recent: Sequence[ev.RobotTruth], what: str, at: float
) -> None:
    """Steps may be counted from the goal's start or from the robot's."""
    least = recent[0].steps - start - STEP_SLACK
    most = recent[-1].steps + STEP_SLACK
    expect(
        least <= claimed <= most,
        expected=f"{what} about {recent[-1].steps - start}",
        observed=f"{claimed}",
        help="Take it from robot_state.steps, less what it was when the goal was accepted.",
        at=at,
    )


def _recent(run: Transcript, t: float) -> Sequence[ev.RobotTruth]:
    return run.robot_between(t - REPORT_AGE, t)
