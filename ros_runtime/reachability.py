"""Wait until a node that has just appeared answers requests."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence

from rcl_interfaces.srv import ListParameters
from rclpy.client import Client
from rclpy.node import Node

UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"  # rmw's name for a node that it has discovered but not identified yet
ANSWER_TIMEOUT = 0.1  # s to wait for an answer before the next request


def wait_until_reachable(node: Node, name: str, should_stop: Callable[[], bool]) -> bool:
    """Request a node's parameter list repeatedly until it answers.

    Discovery is not simultaneous: a request or answer is lost while only one of two nodes has discovered the other.
    Listing parameters has no side effect, so this request can be repeated.

    Args:
        node: sends the requests; another thread spins it.
        name: the full name of the node to reach.
        should_stop: called between two requests; True ends the wait.

    Returns:
        Whether the node has answered.
    """
    return name in wait_until_all_reachable(node, [name], should_stop)


def wait_until_all_reachable(node: Node, names: Sequence[str], should_stop: Callable[[], bool]) -> set[str]:
    """Like `wait_until_reachable`, for several nodes at once; return the names of those that answered."""
    clients = {name: node.create_client(ListParameters, f"{name}/list_parameters") for name in names}
    reachable: set[str] = set()
    try:
        while len(reachable) < len(clients) and not should_stop():
            found = {
                name: client
                for name, client in clients.items()
                if name not in reachable and client.service_is_ready()
            }
            if not found:
                time.sleep(ANSWER_TIMEOUT / 10)
            reachable |= _request_once(found)
    finally:
        for client in clients.values():
            node.destroy_client(client)
    return reachable


def _request_once(clients: Mapping[str, Client]) -> set[str]:
    """Send each client's request once; return the names of the nodes that answered within ANSWER_TIMEOUT."""
    sent = {
        name: (client.call_async(ListParameters.Request()), threading.Event())
        for name, client in clients.items()
    }
    for future, answered in sent.values():
        future.add_done_callback(lambda _, answered=answered: answered.set())
    deadline = time.monotonic() + ANSWER_TIMEOUT
    in_time = {
        name for name, (_, answered) in sent.items() if answered.wait(max(0.0, deadline - time.monotonic()))
    }
    for name in sent.keys() - in_time:
        clients[name].remove_pending_request(sent[name][0])
    return in_time
