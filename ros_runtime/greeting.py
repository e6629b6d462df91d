"""Making sure that a node that has just appeared can be talked to."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from rcl_interfaces.srv import ListParameters
from rclpy.node import Node

PATIENCE = 0.1  # s for one answer


def greet(node: Node, name: str, gives_up: Callable[[], bool]) -> bool:
    """Ask the node called `name` (in full) for its parameters until it answers; returns whether it has.

    `node`, spun by another thread, does the asking. Two nodes find each other step by step: for a moment one knows
    the other and is not yet known, and whatever is asked or answered in that moment is lost. So this asks something
    harmless, again and again, until `gives_up()`.
    """
    client = node.create_client(ListParameters, f"{name}/list_parameters")
    try:
        while not gives_up():
            if not client.service_is_ready():
                time.sleep(PATIENCE / 10)
                continue
            answered = threading.Event()
            future = client.call_async(ListParameters.Request())
            future.add_done_callback(lambda _, answered=answered: answered.set())
            if answered.wait(PATIENCE):
                return True
            client.remove_pending_request(future)
        return False
    finally:
        node.destroy_client(client)
