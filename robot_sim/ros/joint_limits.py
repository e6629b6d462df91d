"""Publishes the topic joint_limits."""

from __future__ import annotations

import mujoco
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile

from humanoid_interfaces.msg import JointLimits
from robot_sim.arms.joint_trajectory import MOVABLE
from robot_sim.arms.upper_body import UpperBodyParameters
from robot_sim.ros.messages import floats


def publish_joint_limits(node: Node, model: mujoco.MjModel, latched: QoSProfile) -> Publisher:
    """Publish the limits of the joints that a trajectory can move; later subscribers receive the message, too."""
    ranges = model.jnt_range[[model.joint(name).id for name in MOVABLE]]
    speeds = UpperBodyParameters()
    message = JointLimits(
        names=list(MOVABLE),
        lower=floats(ranges[:, 0]),
        upper=floats(ranges[:, 1]),
        velocity=[speeds.speed_limit(name) for name in MOVABLE],
    )
    publisher = node.create_publisher(JointLimits, "joint_limits", latched)
    publisher.publish(message)
    return publisher
