"""Poses for the goals of scenarios and the results of scripted servers."""

from __future__ import annotations

import math

from geometry_msgs.msg import PoseStamped


def pose_at(x: float, y: float, yaw: float, frame: str = "odom") -> PoseStamped:
    """Return a pose on the floor of a frame (m, m, rad)."""
    pose = PoseStamped()
    pose.header.frame_id = frame
    pose.pose.position.x, pose.pose.position.y = x, y
    pose.pose.orientation.z, pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return pose
