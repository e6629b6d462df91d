"""Reads the live ROS graph: nodes, and topics with their publishers and subscriptions.

Nodes whose names begin with "_" are left out, as in `ros2 node list`. Each running `ros2` command has such a node.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rclpy.qos import DurabilityPolicy, QoSCompatibility, QoSProfile, ReliabilityPolicy, qos_check_compatible
from rclpy.topic_endpoint_info import TopicEndpointInfo

from lab.client.connection import connection
from lab.errors import LabError
from ros_runtime.reachability import UNKNOWN_NODE

STANDARD_TOPICS = ("/parameter_events", "/rosout")
HIDDEN = "_"  # prefix of hidden nodes, such as those of ros2 commands


@dataclass(frozen=True)
class Endpoint:
    """A publisher or subscription of a topic: its node's full name, its type, and the offered or requested QoS."""

    node: str
    type: str
    qos: QoSProfile

    def qos_in_words(self) -> str:
        """Describe reliability and durability, such as "best effort" or "reliable, transient local"."""
        reliable = self.qos.reliability == ReliabilityPolicy.RELIABLE
        latched = self.qos.durability == DurabilityPolicy.TRANSIENT_LOCAL
        return ("reliable" if reliable else "best effort") + (", transient local" if latched else "")


@dataclass(frozen=True)
class Topic:
    """A topic with its publishers and subscriptions."""

    name: str
    type: str
    publishers: tuple[Endpoint, ...]
    subscriptions: tuple[Endpoint, ...]

    def incompatible_with(self, subscription: Endpoint) -> list[Endpoint]:
        """Return the publishers that offer less than this subscription requests."""
        return [
            publisher
            for publisher in self.publishers
            if qos_check_compatible(publisher.qos, subscription.qos)[0] == QoSCompatibility.ERROR
        ]


def topics_in_graph(*names: str) -> list[Topic]:
    """Return the topics with these names, sorted; without names, all topics except those that every node has.

    A name without a leading slash is relative to the robot's namespace.

    Raises LabError for a topic that has no publisher and no subscription; the message lists the existing topics.
    """
    node = connection().node
    types = dict(node.get_topic_names_and_types())
    wanted = [node.resolve_topic_name(name) for name in names]
    missing = [name for name in wanted if name not in types]
    if missing:
        raise LabError(
            f"no node publishes or subscribes to {', '.join(missing)}; the topics are: {', '.join(sorted(types))}"
        )
    return [
        Topic(
            name,
            types[name][0],
            _endpoints(node.get_publishers_info_by_topic(name)),
            _endpoints(node.get_subscriptions_info_by_topic(name)),
        )
        for name in sorted(wanted or types.keys() - set(STANDARD_TOPICS))
    ]


def list_graph(*names: str) -> None:
    """Print topics with their type, publishers and subscribers, and which subscriptions have an incompatible QoS.

    Without names it prints all topics except /rosout and /parameter_events, which every node has.
    """
    for topic in topics_in_graph(*names):
        print(f"{topic.name}  {topic.type}")
        for publisher in topic.publishers:
            print(f"    from {publisher.node}: {publisher.qos_in_words()}")
        for subscription in topic.subscriptions:
            print(f"    to   {subscription.node}: {subscription.qos_in_words()}")
            for publisher in topic.incompatible_with(subscription):
                print(
                    f"         receives nothing from {publisher.node}, which offers only {publisher.qos_in_words()}"
                )


def nodes_in_graph() -> list[str]:
    """Return the full names of all nodes except hidden ones, sorted."""
    return sorted(
        _full_name(namespace, name)
        for name, namespace in connection().node.get_node_names_and_namespaces()
        if name != UNKNOWN_NODE and not name.startswith(HIDDEN)
    )


def _endpoints(infos: Iterable[TopicEndpointInfo]) -> tuple[Endpoint, ...]:
    ends = (
        Endpoint(_full_name(info.node_namespace, info.node_name), info.topic_type, info.qos_profile)
        for info in infos
        if not info.node_name.startswith(HIDDEN)
    )
    return tuple(sorted(ends, key=lambda end: end.node))


def _full_name(namespace: str, name: str) -> str:
    return f"{namespace.rstrip('/')}/{name}"
