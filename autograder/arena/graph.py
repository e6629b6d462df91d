"""The ROS graph: which nodes, topics and services there are. Any participant can write into it, so it is not trusted.

The graph is queried by the names of topics and services, so that the cost does not depend on the number of nodes or on
their names. A query that fails returns an empty result, and `Graph.inspect` records the failure.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Collection
from contextlib import suppress
from typing import TypeVar

from rclpy.exceptions import InvalidNamespaceException, InvalidNodeNameException
from rclpy.node import Node
from rclpy.qos import QoSCompatibility, QoSProfile, qos_check_compatible
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog

MOST_NODES = 50  # a correct program has one or two
MOST_ENDPOINTS = 100  # of one topic or service that are inspected one by one
MOST_SERVICES = 40  # that a report lists
MOST_TOPICS = 20  # that a report lists, in each direction
MOST_NAMES = 1000  # of nodes and services that are inspected one by one
RCLPY_SERVICE_TYPES = (
    "rcl_interfaces/",
    "type_description_interfaces/",
)  # types of services that rclpy offers itself
ROBOT_SERVICE = "compute_arm_ik"  # the service that the robot itself offers
RCLPY_TOPIC = "/parameter_events"
COMMON_TOPICS = (RCLPY_TOPIC, "/rosout", "/clock")

T = TypeVar("T")
_SERVICE_TYPE = re.compile(r"(\w+)::srv::dds_::(\w+)_Request_")


class Graph:
    """The ROS graph as `node` sees it."""

    def __init__(self, node: Node, log: ArenaLog) -> None:
        self._node = node
        self._log = log
        self._failures: Counter[str] = Counter()

    def has_another_node(self) -> bool:
        """Return whether there is another rclpy node than the grader's own."""
        return self.count_publishers(RCLPY_TOPIC) > 1

    def count_publishers(self, topic: str) -> int:
        """Count the publishers of a topic."""
        return self._ask(lambda: self._node.count_publishers(topic), 0)

    def count_clients(self, service: str) -> int:
        """Count the clients of a service, of any type."""
        return self._ask(lambda: self._node.count_clients(service), 0)

    def count_matchable_subscribers(self, topic: str) -> int:
        """Count the subscriptions of a topic, except those whose QoS no known publisher can serve."""
        count = self._count_subscribers(topic)
        if count > MOST_ENDPOINTS or self.count_publishers(topic) > MOST_ENDPOINTS:
            return count
        return self._ask(lambda: self._count_matchable(topic), count)

    def owners_of(self, service: str) -> list[str]:
        """Return the full names of the nodes that offer a service, without invalid ones."""
        if self._ask(lambda: self._node.count_services(service), 0) > MOST_ENDPOINTS:
            return []
        # the servers are the subscribers of the request topic
        topic = f"rq{self._node.resolve_service_name(service)}Request"
        nothing: list[TopicEndpointInfo] = []
        servers = self._ask(
            lambda: self._node.get_subscriptions_info_by_topic(topic, no_mangle=True), nothing
        )
        nodes = dict.fromkeys((server.node_namespace, server.node_name) for server in servers)
        return [f"{namespace.rstrip('/')}/{name}" for namespace, name in nodes if _is_known(namespace, name)]

    def offered(self) -> list[str]:
        """List offered services as 'name [type]', up to MOST_SERVICES, without the robot's and rclpy's own ones."""
        nothing: list[tuple[str, list[str]]] = []
        robots = self._node.resolve_service_name(ROBOT_SERVICE)
        found = self._ask(self._node.get_service_names_and_types, nothing)
        names = [
            (name, types[0] if len(types) == 1 else self._type_of_server(name) or types[0])
            for name, types in found[:MOST_NAMES]
            if types and name != robots and not types[0].startswith(RCLPY_SERVICE_TYPES)
        ]
        offered = [f"{name} [{kind}]" for name, kind in names[:MOST_SERVICES] if self._is_offered(name)]
        more = len(found) - len(found[:MOST_NAMES]) + len(names) - len(names[:MOST_SERVICES])
        return sorted(offered) + ([f"and up to {more:,} more"] if more else [])

    def _type_of_server(self, service: str) -> str:
        """Return the type of a service's server, where a client uses another type; '' if it cannot be found."""
        nothing: list[TopicEndpointInfo] = []
        servers = self._ask(
            lambda: self._node.get_subscriptions_info_by_topic(f"rq{service}Request", no_mangle=True), nothing
        )
        types = (_SERVICE_TYPE.fullmatch(server.topic_type) for server in servers[:MOST_ENDPOINTS])
        return next((f"{found[1]}/srv/{found[2]}" for found in types if found), "")

    def report_topics(self, robot_subscribes: Collection[str]) -> None:
        """Record what the student's node publishes and subscribes to, in the robot's namespace and elsewhere."""
        nothing: list[tuple[str, list[str]]] = []
        found = self._ask(self._node.get_topic_names_and_types, nothing)[:MOST_NAMES]
        names = [name for name, _types in found if name not in COMMON_TOPICS and "/_action/" not in name]
        own = self._node.get_namespace() + "/"  # the robot publishes the other topics of this namespace
        publishes = [name for name in names if name in robot_subscribes or not name.startswith(own)]
        subscribes = [name for name in names if name not in robot_subscribes]
        self._log.append(
            ev.NodeTopics(
                publishes=[name for name in publishes if self.count_publishers(name)][:MOST_TOPICS],
                subscribes=[name for name in subscribes if self._count_subscribers(name)][:MOST_TOPICS],
            )
        )

    def inspect(self) -> None:
        """Record a graph that no correct program causes: too many nodes, an invalid name, failed queries."""
        nobody: list[tuple[str, str]] = []
        nodes = self._ask(self._node.get_node_names_and_namespaces, nobody)
        invalid = [name for name, namespace in nodes[:MOST_NAMES] if not _is_valid(namespace, name)]
        reason = ""
        if len(nodes) > MOST_NODES:
            reason = f"there were {len(nodes):,} nodes"
        elif invalid:
            reason = f"a node was called {invalid[0][:60]!r}, which is not a valid node name"
        elif self._failures:
            first, times = next(iter(self._failures)), sum(self._failures.values())
            reason = f"{times:,} queries of the ROS graph failed, the first with {first}"
        if reason:
            self._log.append(ev.GraphFlooded(nodes=len(nodes), reason=reason))
            self._failures.clear()

    def _count_subscribers(self, topic: str) -> int:
        return self._ask(lambda: self._node.count_subscribers(topic), 0)

    def _count_matchable(self, topic: str) -> int:
        offered = [publisher.qos_profile for publisher in self._node.get_publishers_info_by_topic(topic)]
        wanted = [subscriber.qos_profile for subscriber in self._node.get_subscriptions_info_by_topic(topic)]
        return sum(not offered or any(_serves(qos, profile) for qos in offered) for profile in wanted)

    def _is_offered(self, service: str) -> bool:
        return self._ask(lambda: self._node.count_services(service), 0) > 0

    def _ask(self, query: Callable[[], T], otherwise: T) -> T:
        """Query the middleware; if that fails in any way, count the failure and return `otherwise`."""
        try:
            return query()
        except Exception as error:  # such as UnicodeDecodeError or RCLError, caused by a foreign name
            self._failures[f"{type(error).__name__}: {error}"[:200]] += 1
            return otherwise


def _serves(offered: QoSProfile, wanted: QoSProfile) -> bool:
    compatibility, _reason = qos_check_compatible(offered, wanted)
    return compatibility != QoSCompatibility.ERROR


def _is_known(namespace: str, name: str) -> bool:
    """Return whether these are valid names, and not the middleware's placeholder for an unknown node."""
    return not name.startswith("_NODE_NAME_UNKNOWN") and _is_valid(namespace, name)


def _is_valid(namespace: str, name: str) -> bool:
    with suppress(InvalidNodeNameException, InvalidNamespaceException, TypeError):
        return bool(validate_node_name(name) and validate_namespace(namespace))
    return False
