"""Calls services, with a time limit."""

from __future__ import annotations

import time
from typing import Any

from lab.client.connection import connection
from lab.client.exchange import give_up, require_server
from lab.client.topics import taken_robot
from lab.errors import LabError
from ros_runtime.cell_notice import notice


def call(service: str, service_type: Any, request: Any = None, *, timeout: float = 2.0) -> Any:
    """Send a request and return the response.

    Args:
        service: its name, relative to the robot's namespace.
        service_type: such as `std_srvs.srv.Trigger`.
        request: a `service_type.Request`; None sends an empty one.
        timeout: s, for finding the server and for its response together.

    Raises:
        NoServerError: no node offers the service.
        NoAnswerError: a server exists but did not respond in time; it may still have executed the request.
    """
    if request is not None and not isinstance(request, service_type.Request):
        wanted = f"{service_type.__name__}.Request"
        raise LabError(f"the request is a {type(request).__name__}; {service} takes a {wanted}(…)")
    deadline = time.monotonic() + timeout
    client = connection().client(service_type, service)
    require_server(lambda: not client.unmatched(), service, service_type, timeout)
    sent = client.send(request)
    with notice(f"This waits up to {timeout:g} s for the response of {service}."):
        if not sent.wait(max(0.0, deadline - time.monotonic())):
            raise give_up(sent, timeout, service, f"no answer from {service} within {timeout:g} s.")
    if taken := taken_robot():
        print(f"Note: {taken}.")
    return sent.response


def service_is_ready(service: str, service_type: Any) -> bool:
    """Whether a server has been discovered, like rclpy's `service_is_ready()`; it may no longer run."""
    return not connection().client(service_type, service).unmatched()
