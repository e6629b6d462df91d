"""Requirements on a fall, for any action: when the robot fell, and that the goal was then ABORTED with FELL."""

from __future__ import annotations

import math

from autograder.authoring.diagnosis.goal_diagnosis import why_rclpy_aborted
from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.goal import ABORTED, Goal
from autograder.authoring.evidence.robot_record import RobotRecord
from autograder.authoring.failure import expect
from autograder.authoring.walking.reports import require_error_code
from humanoid_interfaces.msg import RobotState

DETECTION_LEAD = 1.0  # s by which a server may detect a fall before the simulator does


def fall_after(run: RobotRecord, since: float, until: float = math.inf) -> ev.RobotTruth | None:
    """Return the first sample from `since` to `until` (s) in which the robot has fallen, or None."""
    robots = run.robot_between(since, min(until, run.end))
    return next((robot for robot in robots if robot.mode == RobotState.FALLEN), None)


def require_knocked_over(run: RobotRecord) -> ev.RobotTruth:
    """Return the first sample after the scenario's push in which the robot has fallen; raise if there is none."""
    if fallen := fall_after(run, run.last_command("push").t):
        return fallen
    raise unseen(run, "the robot did not fall")


def require_fall_reported(goal: Goal, fallen: ev.RobotTruth) -> None:
    """Require that an accepted goal went on until the robot fell, and was then ABORTED with FELL."""
    result = goal.require_result(
        ABORTED,
        help=f"The robot fell at {fallen.t:.1f} s and execute went on. Check robot_state.mode in every round.",
    )
    expect(
        result.t >= fallen.t - DETECTION_LEAD,
        expected="the goal to go on until the robot falls",
        observed=f"it ended {fallen.t - result.t:.1f} s before the robot fell",
        help=why_rclpy_aborted(goal)
        or "A push alone is no reason to give up: abort when robot_state.mode is FALLEN.",
        at=result.t,
    )
    require_error_code(goal, "FELL", because="the robot has fallen")
    goal.require_reason()
