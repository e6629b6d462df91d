"""What a node's services are asked, answered without an executor."""

from __future__ import annotations

import time
from typing import Any

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

SHARE = 20  # the answers take at most one part in so many of the robot's time


class Services:
    """Answers the requests of a node, whose owner calls `look` now and then.

    An executor asks the middleware about everything that a node has, some fifty entities, which costs forty times as
    much as taking a request from each service. It is still needed, if rarely, for what is neither a message nor a
    request, such as the news that somebody's quality of service does not fit.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(node)
        self._rest_until = 0.0  # s of time.monotonic()

    def look(self) -> None:
        """Answer at most one request of each service; after a request that took long, not at once again."""
        started = time.monotonic()
        if started < self._rest_until:
            return
        for service in self._node.services:
            kind: Any = service.srv_type
            with service.handle:
                request, header = service.handle.service_take_request(kind.Request)
            if header is not None:
                try:
                    service.send_response(service.callback(request, kind.Response()), header)
                except Exception as error:  # what somebody asks must not end the robot
                    self._node.get_logger().error(
                        f"a request to {service.srv_name} was not answered: {error}"
                    )
                self._rest_until = started + SHARE * (time.monotonic() - started)

    def look_at_the_rest(self) -> None:
        """Do whatever else is due on the node."""
        self._executor.spin_once(timeout_sec=0)
