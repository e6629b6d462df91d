"""What scripted services and actions have in common."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.service import Service
from rclpy.task import Future


def offer(node: Node, service_type: Any, name: str, on_request: Callable[[Any, Any], Any]) -> Service:
    """Offer a service whose callback may await; a response is dropped if the client or the service is gone."""
    service = node.create_service(service_type, name, on_request, callback_group=ReentrantCallbackGroup())
    send = service.send_response

    def send_if_anybody_waits(response: Any, header: Any) -> None:
        with suppress(RuntimeError):  # rclpy's own errors: the client has left, or the service was withdrawn
            send(response, header)

    service.send_response = send_if_anybody_waits  # type: ignore[method-assign]
    return service


async def pause(node: Node, duration: float) -> None:
    """Wait `duration` s on the arena's clock while the node keeps spinning."""
    if duration <= 0:
        return
    over: Future = Future()
    timer = node.create_timer(duration, lambda: over.set_result(None))
    try:
        await over
    finally:
        node.destroy_timer(timer)


def type_name(interface: Any) -> str:
    """Return the ROS name of a type, such as `std_srvs/srv/Trigger`."""
    package, kind = interface.__module__.split(".")[:2]
    return f"{package}/{kind}/{interface.__name__}"
