"""What the robot did according to the simulator: where it arrived, whether it stopped, and whether it stands."""

from __future__ import annotations

import math
from collections.abc import Sequence

from autograder.authoring.diagnosis.connections import why_no_message_arrives
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.goal import SUCCEEDED, Goal
from autograder.authoring.evidence.robot_record import RobotRecord
from autograder.authoring.failure import expect
from autograder.authoring.walking.planar import YAW_TOLERANCE, error, tolerance
from humanoid_interfaces.msg import RobotState

_ACCEPT = (
    "goal_callback must return GoalResponse.ACCEPT for a finite pose in frame odom while the motors are on (True is "
    "not GoalResponse.ACCEPT)."
)
_FREE_AGAIN = (
    "An earlier goal was accepted and had ended: clear your flag that the robot is busy whenever execute ends, in a "
    "finally block."
)
RECENT_TIME = 0.6  # s
STOP_TIME = 2.0  # s
WATCH_TIME = 3.5  # s after the cancel in which the robot is observed
STOP = "Publish a zero Twist on cmd_vel before the terminal call, and nothing else on it afterwards."


def require_accepted(goal: Goal) -> Goal:
    """Require that the server accepted the goal."""
    causes = (why_no_message_arrives(goal.run, topic) for topic in ("odom", "robot_state"))
    is_later = any(result.t < goal.sent.t for result in goal.run.all(ev.ResultReceived))
    return goal.require_accepted(next(filter(None, causes), _FREE_AGAIN if is_later else _ACCEPT))


def require_arrival(goal: Goal) -> None:
    """Require that the goal succeeded, and that the simulated robot was then within the tolerance of the pose."""
    result, within = require_accepted(goal).require_result(SUCCEEDED), tolerance(goal)
    distance, turn = error(goal.run.robot_at(result.t), goal)
    expect(
        distance <= within and turn <= YAW_TOLERANCE,
        expected=f"the robot within {within:.2f} m and {YAW_TOLERANCE:.2f} rad of the goal when it SUCCEEDED",
        observed=f"{distance:.2f} m and {turn:.2f} rad away in the simulator",
        help=_advice_on_arrival(goal, distance, turn, within),
        at=result.t,
    )


def _advice_on_arrival(goal: Goal, distance: float, turn: float, within: float) -> str:
    """Return which test of the arrival was too tolerant, by the server's own last feedback."""
    if distance <= within:
        return f"The position is right, the heading is {turn:.2f} rad off: turn to the goal's yaw before succeed()."
    claimed = goal.feedback[-1].feedback.distance_remaining if goal.feedback else None
    if claimed is not None and abs(claimed - distance) < within:
        return (
            f"Your own feedback reported {claimed:.2f} m left, and then you called succeed(): let your loop go on "
            f"until less than {within:.2f} m are left."
        )
    if claimed is not None and claimed <= within:
        return (
            f"Your feedback reported {claimed:.2f} m left: measure from odom's pose to the goal, and measure again "
            "once the robot stands."
        )
    return "Compare odom with the goal's pose, stop the robot, and compare again once it stands, before succeed()."


def require_walking(run: RobotRecord, at: float) -> None:
    """Require that the robot walked shortly before a time (s) of the scenario: else it has no walk to stop."""
    expect(
        any(robot.mode == RobotState.WALKING for robot in run.robot_between(at - RECENT_TIME, at)),
        expected="the robot walking to its goal by then",
        observed=f"it does not walk at {at:.1f} s",
        help="Publish a velocity on cmd_vel as soon as the goal executes, and go on publishing it: the robot stops by "
        "itself 0.5 s after the last Twist.",
        at=at,
    )


def require_stopped(
    run: RobotRecord, since: float, event: str = "the cancel", until: float = math.inf
) -> None:
    """Require that the robot stands still and upright from 2 s after an event at `since` (s), at most until `until`."""
    watched = run.robot_between(since + STOP_TIME, min(since + WATCH_TIME, until))
    when = f"within {STOP_TIME:.0f} s of {event}, and still"
    require_standing(watched, when, since, event, STOP, run.robot_ready.still)


def require_standing(
    watched: Sequence[ev.RobotTruth], when: str, since: float, event: str, help: str, limit: float
) -> None:
    """Require that the robot stands upright and slower than `limit` (m/s).

    The failure contains `when`, and the `event` at `since` (s).
    """
    fastest = max(watched, key=lambda robot: robot.speed)
    expect(
        fastest.speed < limit,
        expected=f"the robot slower than {limit:.2f} m/s {when} from then on",
        observed=f"{fastest.speed:.2f} m/s {fastest.t - since:.1f} s after {event}",
        help=help,
        at=fastest.t,
    )
    fallen = next((robot for robot in watched if robot.mode == RobotState.FALLEN or robot.up < 0.6), None)
    expect(
        fallen is None,
        expected="the robot upright",
        observed="it fell",
        help="Stop with a zero Twist on cmd_vel, and publish nothing on motor_power: without torque the robot falls.",
        at=fallen.t if fallen else None,
    )
