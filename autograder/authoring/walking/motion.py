"""How the robot moved on its way to a goal: whether it got there, how fast, and which way round it turned."""

from __future__ import annotations

import math
from itertools import pairwise

from autograder.authoring.diagnosis.goal_diagnosis import why_rclpy_aborted, why_starved
from autograder.authoring.diagnosis.missing import not_shown
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.goal import Goal
from autograder.authoring.failure import Failure, expect
from autograder.authoring.walking.planar import POSITION_TOLERANCE, YAW_TOLERANCE, error, heading
from autograder.authoring.walking.truth import require_accepted
from ros_runtime.angles import wrap

SPEED_SLACK = 1.1  # times the limit
TURN_SLACK = 1.0  # rad by which the robot may turn more than necessary
MOVED_DISTANCE = 0.1  # m


def require_reached(goal: Goal) -> ev.RobotTruth:
    """Require that the robot was at the goal at some time, and return its first sample there."""
    robots = _on_its_way(goal)
    for robot in robots:
        distance, turn = error(robot, goal)
        if distance <= POSITION_TOLERANCE and turn <= YAW_TOLERANCE:
            return robot
    nearest, turn = min(error(robot, goal) for robot in robots)
    raise Failure(
        expected=f"the robot to come within {POSITION_TOLERANCE:.2f} m and {YAW_TOLERANCE:.2f} rad of the goal",
        observed=f"at its nearest it was {nearest:.2f} m and {turn:.2f} rad away in the simulator",
        help=_advice_on_the_way(goal, nearest),
        at=robots[-1].t,
    )


def _advice_on_the_way(goal: Goal, nearest: float) -> str:
    """Return why the robot did not get there, by how far it went."""
    if reason := why_rclpy_aborted(goal) or why_starved(goal):
        return reason
    start = goal.run.robot_at(goal.sent.t)
    distance, _ = error(start, goal)
    if nearest <= POSITION_TOLERANCE:
        return "It came near enough, but never with the right heading: command angular.z, with wrap(goal's yaw - yaw)."
    if max(math.hypot(robot.x - start.x, robot.y - start.y) for robot in _on_its_way(goal)) < MOVED_DISTANCE:
        return (
            "It stayed where it was. Publish a Twist on cmd_vel in every round of the loop: the robot stops by itself "
            "0.5 s after the last one."
        )
    if nearest > 0.8 * distance:
        return (
            "It walked, but not toward the goal: cmd_vel is in base_link's axes, so rotate the difference in x and y "
            "by minus the heading."
        )
    return "It walked toward the goal and stopped too early: go on until odom shows that less than 0.10 m are left."


def require_limited_velocity(goal: Goal) -> None:
    """Require that from the goal's sending to the first arrival the robot's mean speed was at most max_velocity.

    The straight distance is used, so that neither a turn on the spot nor the sway of the pelvis counts.
    """
    limit = goal.request.max_velocity
    start = goal.run.robot_at(require_accepted(goal).sent.t)
    arrival = next((each for each in _on_its_way(goal) if error(each, goal)[0] <= POSITION_TOLERANCE), None)
    if arrival is None:
        raise not_shown(goal.run, f"the robot comes near the goal “{goal.name}”")
    speed = math.hypot(arrival.x - start.x, arrival.y - start.y) / max(arrival.t - start.t, 1e-6)
    expect(
        speed <= SPEED_SLACK * limit,
        expected=f"at most {SPEED_SLACK * limit:.3f} m/s on the way: max_velocity {limit:.3f} m/s, and 10 % more",
        observed=f"{speed:.3f} m/s on average from the start to the arrival",
        help="Read goal_handle.request.max_velocity, and scale linear.x and linear.y together so that math.hypot(x, y) "
        "is at most that: limited one by one, they add up to 1.4 times as much on a diagonal.",
        at=arrival.t,
    )


def require_short_turn(goal: Goal) -> None:
    """Require that the robot turned to the goal's heading the shorter way round."""
    robots = _on_its_way(goal)
    target = heading(goal.request.target_pose.pose.orientation)
    least = abs(wrap(target - robots[0].yaw))
    turned = abs(sum(wrap(later.yaw - earlier.yaw) for earlier, later in pairwise(robots)))
    expect(
        turned <= least + TURN_SLACK,
        expected=f"a turn of about {least:.2f} rad, from yaw {robots[0].yaw:.2f} to {target:.2f}",
        observed=f"{turned:.2f} rad, the longer way round",
        help="Headings jump from pi to -pi. Wrap their difference: math.atan2(math.sin(d), math.cos(d)).",
        at=robots[-1].t,
    )


def _on_its_way(goal: Goal) -> list[ev.RobotTruth]:
    """Return the robot from the goal's acceptance to its result, or as long as the scenario waited for that."""
    given_up = goal.run.given_up("result", goal.name)
    end = goal.result.t if goal.result else given_up.t if given_up else goal.run.end
    return list(goal.run.robot_between(require_accepted(goal).accepted_at, end))
