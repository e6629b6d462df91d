"""Publishes the force and torque on each foot."""

from __future__ import annotations

from geometry_msgs.msg import WrenchStamped
from rclpy.node import Node

from robot_sim.humanoid import Humanoid
from robot_sim.model.side import SIDES
from robot_sim.ros.messages import has_subscribers, set_fields

FOOT_RATE = 50.0  # Hz, in simulated time


class FootTopics:
    """The topics l_foot/wrench and r_foot/wrench; their frames, l_sole and r_sole, are named as in REP 120."""

    def __init__(self, node: Node, humanoid: Humanoid) -> None:
        self._node = node
        self._humanoid = humanoid
        self._publishers = {
            side: node.create_publisher(WrenchStamped, f"{side.letter}_foot/wrench", 10) for side in SIDES
        }
        self.jobs = ((FOOT_RATE, self._publish),)

    def _publish(self) -> None:
        for side, publisher in self._publishers.items():
            if has_subscribers(publisher):
                wrench, message = self._humanoid.feet[side].read(), WrenchStamped()
                message.header.stamp = self._node.get_clock().now().to_msg()
                message.header.frame_id = f"{side.letter}_sole"
                set_fields(message.wrench.force, "xyz", wrench.force)
                set_fields(message.wrench.torque, "xyz", wrench.torque)
                publisher.publish(message)
