"""Wait until a node that has just appeared answers requests."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence

from rcl_interfaces.srv import ListParameters
from rclpy.client import Client
from rclpy.node import Node

ANSWER_TIMEOUT = 0.1  # s for one answer


def wait_until_reachable(node: Node, name: str, gives_up: Callable[[], bool]) -> bool:
    """Ask a node for its parameters, again and again, until it answers.

    Two nodes discover each other step by step. For a moment one knows the other and is not yet known, and any request
    or answer in that moment is lost. A request for the parameters does no harm, so it is repeated.

    Args:
        node: asks; another thread spins it.
        name: the full name of the node that is asked.
        gives_up: is called between two questions; True ends the wait.

    Returns:
        Whether it has answered.
    """
    return name in wait_until_all_reachable(node, [name], gives_up)


def wait_until_all_reachable(node: Node, names: Sequence[str], gives_up: Callable[[], bool]) -> set[str]:
    """Ask several nodes at once, as `wait_until_reachable` asks one; return the names of those that answered."""
    clients = {name: node.create_client(ListParameters, f"{name}/list_parameters") for name in names}
    reachable: set[str] = set()
    try:
        while len(reachable) < len(clients) and not gives_up():
            found = {
                name: client
                for name, client in clients.items()
                if name not in reachable and client.service_is_ready()
            }
            if not found:
                time.sleep(ANSWER_TIMEOUT / 10)
            reachable |= _ask_once(found)
    finally:
        for client in clients.values():
            node.destroy_client(client)
    return reachable


def _ask_once(clients: Mapping[str, Client]) -> set[str]:
    """Ask all of them; return the names of those that answered in time."""
    asked = {
        name: (client.call_async(ListParameters.Request()), threading.Event())
        for name, client in clients.items()
    }
    for future, answered in asked.values():
        future.add_done_callback(lambda _, answered=answered: answered.set())
    deadline = time.monotonic() + ANSWER_TIMEOUT
    in_time = {
        name for name, (_, answered) in asked.items() if answered.wait(max(0.0, deadline - time.monotonic()))
    }
    for name in asked.keys() - in_time:
        clients[name].remove_pending_request(asked[name][0])
    return in_time
