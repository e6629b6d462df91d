"""Call a service and wait for its answer, with a time limit."""

from __future__ import annotations

import time
from typing import Any

from lab.client.connection import connection
from lab.client.exchange import give_up, require_server
from lab.errors import LabError


def call(service: str, service_type: Any, request: Any = None, *, timeout: float = 2.0) -> Any:
    """Send a request and return the response.

    Args:
        service: its name, relative to the robot's namespace.
        service_type: such as `std_srvs.srv.Trigger`.
        request: a `service_type.Request`; None sends an empty one.
        timeout: s, for finding the server and for its answer together.

    Raises:
        NoServerError: nobody offers the service.
        NoAnswerError: a server exists but did not answer in time; it may have done what you asked.
    """
    if request is not None and not isinstance(request, service_type.Request):
        wanted = f"{service_type.__name__}.Request"
        raise LabError(f"the request is a {type(request).__name__}; {service} takes a {wanted}(…)")
    deadline = time.monotonic() + timeout
    client = connection().client(service_type, service)
    require_server(lambda: not client.unmatched(), service, service_type, timeout)
    asked = client.send(request)
    if not asked.wait(max(0.0, deadline - time.monotonic())):
        raise give_up(
            asked,
            timeout,
            f"no answer from {service} within {timeout:g} s. The request was sent; whether it was carried out is "
            "unknown. If the server still runs, it is busy: a callback must not wait, sleep or call another service "
            "while the node has only one thread.",
        )
    return asked.response


def service_is_ready(service: str, service_type: Any) -> bool:
    """Whether rclpy's `service_is_ready()` is true: a server has been discovered, which may no longer run."""
    return not connection().client(service_type, service).unmatched()
