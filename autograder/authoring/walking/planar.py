"""Poses in the plane."""

from __future__ import annotations

import math

from geometry_msgs.msg import Pose, PoseStamped, Quaternion

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.goal import Goal
from ros_runtime.angles import wrap, yaw_of

POSITION_TOLERANCE = 0.10  # m
YAW_TOLERANCE = 0.15  # rad


def error(robot: ev.RobotTruth, goal: Goal) -> tuple[float, float]:
    """Return how far the robot is from the goal: m, rad."""
    pose = target(goal)
    distance = math.hypot(robot.x - pose.position.x, robot.y - pose.position.y)
    return distance, turn(robot, pose.orientation)


def stamped_target(goal: Goal) -> PoseStamped:
    """Return the pose a goal asks for, with its frame: WalkTo's target_pose, or NavigateToPose's pose."""
    request = goal.request
    return request.target_pose if hasattr(request, "target_pose") else request.pose


def target(goal: Goal) -> Pose:
    """Return the pose a goal asks for."""
    return stamped_target(goal).pose


def numbers_of(pose: Pose) -> dict[str, float]:
    """Return the numbers of a pose by the names of its fields, such as "position.x"."""
    place = {f"position.{axis}": getattr(pose.position, axis) for axis in "xyz"}
    return place | {f"orientation.{axis}": getattr(pose.orientation, axis) for axis in "xyzw"}


def tolerance(goal: Goal) -> float:
    """Return how far (m) from the pose the robot may stand at success: NavigateToPose's tolerance, or 0.10 m."""
    return getattr(goal.request, "tolerance", 0.0) or POSITION_TOLERANCE


def turn(robot: ev.RobotTruth, orientation: Quaternion) -> float:
    """Return how far (rad) the robot's heading is from that of an orientation."""
    return abs(wrap(robot.yaw - heading(orientation)))


def heading(orientation: Quaternion) -> float:
    """Return the heading (rad) of an orientation."""
    return yaw_of(orientation.x, orientation.y, orientation.z, orientation.w)
