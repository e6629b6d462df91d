"""Publishes the topic joint_limits."""

from __future__ import annotations

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile

from humanoid_interfaces.msg import JointLimits
from robot_sim.arms.upper_body import UpperBodyParameters
from robot_sim.humanoid import Humanoid
from robot_sim.ros.messages import floats


def publish_joint_limits(node: Node, humanoid: Humanoid, latched: QoSProfile) -> Publisher:
    """Publish the limits of the joints that a trajectory can move; later subscribers receive the message, too."""
    names = list(humanoid.body.movable)
    ranges = humanoid.model.jnt_range[[humanoid.model.joint(name).id for name in names]]
    speeds = UpperBodyParameters()
    message = JointLimits(
        names=names,
        lower=floats(ranges[:, 0]),
        upper=floats(ranges[:, 1]),
        velocity=[speeds.speed_limit(name) for name in names],
    )
    publisher = node.create_publisher(JointLimits, "joint_limits", latched)
    publisher.publish(message)
    return publisher
