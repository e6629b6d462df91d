"""The notebook's own ROS node: its domain, its cached clients, and the background thread that spins it."""

from __future__ import annotations

import os
import threading
import traceback
import weakref
from collections.abc import Callable, Hashable
from functools import cache
from typing import Any, TypeVar

import rclpy
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node, NodeNameNonExistentError
from rclpy.signals import SignalHandlerOptions

from lab.client.interaction_log import conversation
from lab.client.waiting import becomes_true
from lab.errors import LabError
from ros_runtime.environment import ros_environment
from ros_runtime.notebook_domains import announce, expect_node, forget_node
from ros_runtime.recorded_client.service_client import ServiceClient
from ros_runtime.ros_domain import NoDomainLeft, ReservedDomain, loopback_variables

NAMESPACE = "/robot"
ROBOT_NODE = f"{NAMESPACE}/humanoid"
STANDARD_SERVICES = (
    "describe_parameters",
    "get_parameter_types",
    "get_parameters",
    "get_type_description",
    "list_parameters",
    "set_parameters",
    "set_parameters_atomically",
)
UNLISTED_ACTION_SERVICES = ("cancel_goal", "get_result")  # send_goal stands for the whole action

T = TypeVar("T")

_connection: Connection | None = None


def connection() -> Connection:
    """Return the kernel's connection to the ROS graph; the first call makes it."""
    global _connection
    if _connection is None:
        _connection = Connection()
    return _connection


def node() -> Node:
    """Return the notebook's own rclpy node, for things that `lab` has no function for. The lab spins it."""
    return connection().node


def disconnect() -> None:
    """Leave the ROS graph; the next `connection()` makes a new node."""
    global _connection
    if _connection is not None:
        _connection.close()
        _connection = None


@cache
def join_ros_domain() -> ReservedDomain:
    """Reserve a ROS domain until this process ends, and set this process's environment variables for it.

    The terminals of the same JupyterLab can join the domain.

    Raises LabError when all domains are in use.
    """
    try:
        domain = ReservedDomain()
    except NoDomainLeft as error:
        raise LabError(f"{error}: shut down idle kernels") from error
    os.environ.update(ros_environment() | loopback_variables())
    os.environ["ROS_DOMAIN_ID"] = str(domain.domain_id)
    os.environ.pop("ROS_AUTOMATIC_DISCOVERY_RANGE", None)  # it would override the network settings
    announce(domain.domain_id)
    return domain


class Connection:
    """A node in the robot's namespace, with its publishers, subscriptions and clients."""

    def __init__(self) -> None:
        self.domain_id = join_ros_domain().domain_id
        self._context = Context()
        rclpy.init(
            args=[],
            context=self._context,
            domain_id=self.domain_id,
            signal_handler_options=SignalHandlerOptions.NO,  # interrupting a cell must not end the node
        )
        self.node = Node(
            "notebook", namespace=NAMESPACE, context=self._context, start_parameter_services=False
        )
        expect_node(self.node.get_fully_qualified_name())
        self._cache: dict[Hashable, Any] = {}
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin, name="lab spin", daemon=True)
        self._thread.start()

    def get_or_create(self, key: Hashable, make: Callable[[Node], T]) -> T:
        """Return the object that is stored under this key; the first call makes it with `make(node)`."""
        if key not in self._cache:
            self._cache[key] = make(self.node)
        return self._cache[key]

    def client(self, service_type: Any, name: str) -> ServiceClient:
        """Return the client of a service.

        A client of the same name but another type is destroyed first, because rcl allows only one type.
        """
        key = ("client", name)
        if key in self._cache and self._cache[key].type is not service_type:
            self._drop_client(self._cache.pop(key).endpoint)
        return self.get_or_create(key, lambda node: ServiceClient(node, name, service_type, conversation))

    def _drop_client(self, client: Any) -> None:
        """Destroy a client and wait until the spinning thread no longer uses it."""
        handle = weakref.ref(client.handle)
        self.node.destroy_client(client)
        del client
        becomes_true(lambda: handle() is None, 1.0)

    def servers(self) -> dict[str, str]:
        """Return the types of the services and actions of other nodes, by full name, without the standard services."""
        found: dict[str, str] = {}
        for name, namespace in self.node.get_node_names_and_namespaces():
            if name != self.node.get_name():
                found |= self.servers_of(name, namespace)
        return found

    def servers_of(self, name: str, namespace: str) -> dict[str, str]:
        """Return the types of the services and actions of one node, by full name, without the standard services."""
        try:
            services = self.node.get_service_names_and_types_by_node(name, namespace)
        except NodeNameNonExistentError:  # the node has just left
            return {}
        return {
            service.partition("/_action/")[0]: types[0].removesuffix("_SendGoal")
            for service, types in services
            if service.rpartition("/")[2] not in (*STANDARD_SERVICES, *UNLISTED_ACTION_SERVICES)
        }

    def close(self) -> None:
        """Stop spinning and destroy the node."""
        forget_node(self.node.get_fully_qualified_name())
        self._context.try_shutdown()
        self._executor.shutdown(timeout_sec=2.0)
        self._thread.join(2.0)
        self.node.destroy_node()

    def _spin(self) -> None:
        while self._context.ok():
            try:
                self._executor.spin()
            except ExternalShutdownException:
                return
            except Exception:
                # a callback or listener of the notebook raised: print the error and keep spinning
                traceback.print_exc()
