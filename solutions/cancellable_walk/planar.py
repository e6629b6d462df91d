"""Poses in the plane."""

from __future__ import annotations

import math

from geometry_msgs.msg import Quaternion

from autograder.authoring import events as ev
from autograder.authoring.goal import Goal


def error(robot: ev.RobotTruth, goal: Goal) -> tuple[float, float]:
    """Return how far the robot is from the goal: m, rad."""
    pose = goal.request.target_pose.pose
    distance = math.hypot(robot.x - pose.position.x, robot.y - pose.position.y)
    return distance, abs(wrap(robot.yaw - yaw(pose.orientation)))


def yaw(orientation: Quaternion) -> float:
    """Return the yaw (rad) of a quaternion x, y, z, w (REP-103)."""
    x, y, z, w = orientation.x, orientation.y, orientation.z, orientation.w
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def wrap(angle: float) -> float:
    """Return an angle (rad) in [-π, π)."""
    return (angle + math.pi) % (2 * math.pi) - math.pi
