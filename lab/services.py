"""Call a service and wait for its answer, with a time limit."""

from __future__ import annotations

import time
from typing import Any

from lab.connection import connection
from lab.errors import LabError, NoAnswerError
from lab.exchange import Exchange, require_server
from lab.formatting import describe_briefly
from lab.student_nodes import output_of_failed_nodes


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
    request = service_type.Request() if request is None else request
    if not isinstance(request, service_type.Request):
        wanted = f"{service_type.__name__}.Request"
        raise LabError(f"the request is a {type(request).__name__}; {service} takes a {wanted}(…)")
    deadline = time.monotonic() + timeout
    client = connection().client(service_type, service)
    require_server(client.service_is_ready, service, service_type, timeout)
    content = describe_briefly(request)
    exchange = Exchange(
        client, request, f"{service} server", service if content == "empty" else f"{service}: {content}"
    )
    if not exchange.wait(max(0.0, deadline - time.monotonic())):
        exchange.give_up(timeout)
        raise NoAnswerError(
            f"no answer from {service} within {timeout:g} s. The request was sent; whether it was carried out is "
            f"unknown. Look at the server: does it run, and what does its log() say?{output_of_failed_nodes()}"
        )
    return exchange.answer


def service_is_ready(service: str, service_type: Any) -> bool:
    """Whether rclpy's `service_is_ready()` is true: a server has been discovered, which may no longer run."""
    return connection().client(service_type, service).service_is_ready()
