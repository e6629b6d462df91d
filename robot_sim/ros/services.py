"""A node's services, answered without an executor."""

from __future__ import annotations

import time
from typing import Any

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

PAUSE_FACTOR = 20  # after a request that took d s, the next one is taken 20·d s after its start


class Services:
    """The services of a node, answered by regular calls of `answer_requests` instead of an executor.

    An executor waits on all of a node's entities, some fifty, which takes forty times as long as taking a request from
    each service. It still has to run at times to process other events, such as an incompatible QoS (`spin_executor`).
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(node)
        self._rest_until = 0.0  # s of time.monotonic()

    def answer_requests(self) -> None:
        """Answer at most one request of each service. After a long request, calls do nothing until a pause is over."""
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
                except Exception as error:  # an error while answering a request must not end the robot
                    self._node.get_logger().error(
                        f"a request to {service.srv_name} was not answered: {error}"
                    )
                self._rest_until = started + PAUSE_FACTOR * (time.monotonic() - started)

    def spin_executor(self) -> None:
        """Process the node's other events, such as those of its publishers."""
        self._executor.spin_once(timeout_sec=0)
