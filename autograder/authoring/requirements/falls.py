"""When a robot fell, and that a goal was then aborted with FELL, whatever the robot was doing."""

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

REACTION = 1.0  # s before the simulator calls it a fall, in which a server may already see one


def fall_after(run: RobotRecord, since: float, until: float = math.inf) -> ev.RobotTruth | None:
    """Return the first sample from `since` to `until` (s) in which the robot is down, or None."""
    robots = run.robot_between(since, min(until, run.end))
    return next((robot for robot in robots if robot.mode == RobotState.FALLEN), None)


def require_knocked_over(run: RobotRecord) -> ev.RobotTruth:
    """Return the first sample after the scenario's push in which the robot is down; raise if there is none."""
    if fallen := fall_after(run, run.told("push").t):
        return fallen
    raise unseen(run, "the robot did not fall")


def require_fell_told(goal: Goal, fallen: ev.RobotTruth) -> None:
    """Require that an accepted goal went on until the robot fell, and was then ABORTED with FELL."""
    result = goal.require_result(
        ABORTED,
        help=f"The robot fell at {fallen.t:.1f} s and execute went on. Look at robot_state.mode in every round.",
    )
    expect(
        result.t >= fallen.t - REACTION,
        expected="the goal to go on until the robot falls",
        observed=f"it ended {fallen.t - result.t:.1f} s before the robot fell",
        help=why_rclpy_aborted(goal)
        or "A push alone is no reason to give up: abort when robot_state.mode is FALLEN.",
        at=result.t,
    )
    require_error_code(goal, "FELL", because="the robot has fallen")
    goal.require_reason()
