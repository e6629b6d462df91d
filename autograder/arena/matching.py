"""Which subscriptions can be matched at all, so that nobody waits for those that cannot."""

from __future__ import annotations

from rclpy.node import Node
from rclpy.qos import QoSCompatibility, QoSProfile, qos_check_compatible


def count_matchable_subscribers(graph: Node, topic: str) -> int:
    """Count the subscriptions of a topic, but for those whose QoS no publisher known to `graph` can serve."""
    offered = [publisher.qos_profile for publisher in graph.get_publishers_info_by_topic(topic)]
    wanted = [subscriber.qos_profile for subscriber in graph.get_subscriptions_info_by_topic(topic)]
    return sum(not offered or any(_serves(qos, profile) for qos in offered) for profile in wanted)


def _serves(offered: QoSProfile, wanted: QoSProfile) -> bool:
    compatibility, _reason = qos_check_compatible(offered, wanted)
    return compatibility != QoSCompatibility.ERROR
