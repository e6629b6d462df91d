"""The node of a command: it discovers the graph, and a separate thread spins it."""

from __future__ import annotations

import os
import threading
import time
from collections import Counter
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any, NamedTuple

import rclpy
from builtin_interfaces.msg import Time
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future
from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden

from ros_cli.errors import print_message
from ros_runtime.notebook_domains import expected_nodes
from ros_runtime.reachability import UNKNOWN_NODE, wait_until_reachable

SPIN_TIME = 1.0  # s; after 0.5 s, as in ros2cli, a busy machine has not found all nodes
# Multiples of the spin time to wait while the wanted entity is missing: in an empty graph 5 s, because Fast DDS
# repeats a lost announcement after 3 s; beside other nodes 3 s, in which a new node announces itself 30 times.
MISSING_FACTOR = 5
MISSING_BESIDE_OTHERS_FACTOR = 3
NOTICE_AFTER = 0.5  # s without the wanted entity, after which a line names it
DISCOVERY_LIMIT_FACTOR = 8  # multiple of the spin time; then discovery ends although the graph changes
QUERY_PERIOD = 0.02  # s between two queries of the graph, because rclpy does not report its changes
ROSOUT = "/rosout"  # a topic that every node publishes


class _Graph(NamedTuple):
    """The names in the graph, sorted."""

    nodes: list[str]
    topics: list[str]
    services: list[str]


class CommandNode:
    """A hidden node. A separate thread spins it, so that Ctrl-C ends every wait of the main thread at once.

    Attributes:
        node: the rclpy node.
    """

    def __init__(self, spin_time: float = SPIN_TIME) -> None:
        self._spin_time = spin_time
        self._context = Context()
        rclpy.init(args=[], context=self._context, signal_handler_options=SignalHandlerOptions.NO)
        self.node = Node(f"_ros2cli_{os.getpid()}", context=self._context, start_parameter_services=False)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin, name="spin", daemon=True)

    def __enter__(self) -> CommandNode:
        self._thread.start()
        expected = Counter(expected_nodes())  # those of the notebook whose cell called the command
        self.find(lambda: expected <= Counter(self.node_names(hidden=True)))
        return self

    def __exit__(self, *_: object) -> None:
        self._context.try_shutdown()
        self._executor.shutdown(timeout_sec=1.0)
        self._thread.join(1.0)
        self.node.destroy_node()

    def discover(self, is_there: Callable[[], bool] = lambda: True, wanted: str = "") -> None:
        """Wait until the graph has not changed for the spin time, and the names of all its nodes are known.

        The wait is three times as long while `is_there` is false, and five times while there is no other node. A line
        on stderr names what is `wanted` while it is missing.
        """
        changed = began = time.monotonic()
        latest = changed + DISCOVERY_LIMIT_FACTOR * self._spin_time
        seen = self._graph()
        while time.monotonic() < min(changed + self._quiet_time(seen, is_there), latest):
            time.sleep(QUERY_PERIOD)
            if wanted and time.monotonic() > began + NOTICE_AFTER and not is_there():
                _say_wanted(wanted)
                wanted = ""
            graph = self._graph()
            if graph != seen or UNKNOWN_NODE in graph.nodes or self._has_nameless_endpoints():
                seen, changed = graph, time.monotonic()

    def find(self, is_there: Callable[[], bool], wanted: str = "") -> bool:
        """Wait until `is_there` is true, at most MISSING_FACTOR times the spin time; return whether it is.

        A line on stderr names what is `wanted` while it is missing.
        """
        if self.wait_until(is_there, NOTICE_AFTER):
            return True
        if wanted:
            _say_wanted(wanted)
        return self.wait_until(is_there, MISSING_FACTOR * self._spin_time - NOTICE_AFTER)

    def wait_until(self, condition: Callable[[], Any], timeout: float = float("inf")) -> bool:
        """Wait for a condition on the graph; return whether it came true within `timeout` s."""
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() >= deadline:
                return False
            time.sleep(QUERY_PERIOD)
        return True

    def is_beside_others(self) -> bool:
        """Return whether the graph has any other node."""
        return len(self.node_names(hidden=True)) > 1

    def node_names(self, *, hidden: bool = False) -> list[str]:
        """Return the full names of the nodes in the graph, sorted; a name occurs once for each node that has it."""
        return sorted(
            full_name(name, namespace)
            for name, namespace in self.node.get_node_names_and_namespaces()
            if name != UNKNOWN_NODE and (hidden or not name.startswith("_"))
        )

    def topics(self, *, hidden: bool = True) -> dict[str, list[str]]:
        """Return the types of each topic by its name."""
        return shown(self.node.get_topic_names_and_types(), hidden)

    def services(self, *, hidden: bool = True) -> dict[str, list[str]]:
        """Return the types of each service by its name."""
        return shown(self.node.get_service_names_and_types(), hidden)

    def now(self) -> Time:
        """Return the present time."""
        return self.node.get_clock().now().to_msg()

    def wait_until_answering(self, server: str, timeout: float) -> bool:
        """Wait until a node answers requests, which may take longer than discovery (see `ros_runtime.reachability`)."""
        deadline = time.monotonic() + timeout
        return wait_until_reachable(self.node, server, lambda: time.monotonic() > deadline)

    def run_in_spin(self, function: Callable[[], Any]) -> Any:
        """Call a function on the spinning thread and return its result: rclpy's action client is not thread-safe."""
        return self.result(self._executor.create_task(function))

    def result(self, future: Future) -> Any:
        """Wait for a future and return its result.

        Raises:
            Exception: the one that the future holds.
        """
        done = threading.Event()
        future.add_done_callback(lambda _: done.set())
        done.wait()
        return future.result()

    def messages(self, message_type: Any, topic: str, qos: QoSProfile) -> SimpleQueue[tuple[int, Any]]:
        """Subscribe; return a queue of messages, each with the time of its arrival (ns, monotonic)."""
        arrived: SimpleQueue[tuple[int, Any]] = SimpleQueue()
        self.node.create_subscription(
            message_type, topic, lambda message: arrived.put((time.monotonic_ns(), message)), qos
        )
        return arrived

    def _graph(self) -> _Graph:
        nodes = sorted(name for name, _ in self.node.get_node_names_and_namespaces())
        return _Graph(nodes, list(self.topics()), list(self.services()))

    def _has_nameless_endpoints(self) -> bool:
        """Return whether a node's endpoints are discovered but not its name, which is announced separately."""
        endpoints = self.node.get_publishers_info_by_topic(ROSOUT)
        return any(endpoint.node_name == UNKNOWN_NODE for endpoint in endpoints)

    def _quiet_time(self, graph: _Graph, is_there: Callable[[], bool]) -> float:
        if len(graph.nodes) == 1:
            return self._spin_time * MISSING_FACTOR
        return self._spin_time * (1 if is_there() else MISSING_BESIDE_OTHERS_FACTOR)

    def _spin(self) -> None:
        try:
            self._executor.spin()
        except ExternalShutdownException:
            return


def _say_wanted(wanted: str) -> None:
    print_message(f"looking for {wanted} …")


def full_name(name: str, namespace: str) -> str:
    """Return the full name of a node: ('humanoid', '/robot') → '/robot/humanoid'."""
    return f"{namespace.rstrip('/')}/{name}"


def split_name(node_name: str) -> tuple[str, str]:
    """Return name and namespace of a node: '/robot/humanoid' → ('humanoid', '/robot')."""
    namespace, _, name = absolute(node_name).rpartition("/")
    return name, namespace or "/"


def absolute(name: str) -> str:
    """Return a name with its leading slash: a command has no namespace of its own."""
    return name if name.startswith("/") else f"/{name}"


def shown(names_and_types: list[tuple[str, list[str]]], hidden: bool) -> dict[str, list[str]]:
    """Return names and types as a sorted dict; names that begin with an underscore are included only if `hidden`."""
    return {
        name: types
        for name, types in sorted(names_and_types)
        if hidden or not topic_or_service_is_hidden(name)
    }
