"""A client of a service, and its calls."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy.node import Node

from ros_runtime.record.client_events import ServiceAnswered, ServiceCalled
from ros_runtime.recorded_client.conversation import Conversation, Request

ANSWER_TIMEOUT = 5.0  # s


class Call:
    """A service request that was sent.

    Attributes:
        response: the server's response; None before it arrives.
    """

    request: Request

    def __init__(self, name: str, conversation: Conversation) -> None:
        self.name = name
        self.response: Any | None = None
        self._conversation = conversation

    def wait(self, timeout: float = ANSWER_TIMEOUT) -> bool:
        """Wait for the answer; return whether it came."""
        return self._conversation.wait("call", self.name, self._is_answered, timeout)

    def on_answer(self, response: Any) -> None:
        """Store the response and record it."""
        if not self._conversation.reading.is_too_large("answer", self.name, response):
            self.response = response
            self._conversation.log.append(ServiceAnswered(call=self.name, response=response))

    def _is_answered(self) -> bool:
        return self.response is not None or self._conversation.was_too_large("answer", self.name)


class ServiceClient:
    """A client of one service; `name` is relative to the node's namespace."""

    def __init__(self, node: Node, name: str, service_type: Any, conversation: Conversation) -> None:
        self.name = name
        self.type = service_type
        self.endpoint = node.create_client(service_type, name)
        self._conversation = conversation

    def unmatched(self) -> list[str]:
        """Return the service's name in a list, or an empty list if a server has been discovered."""
        return [] if self.endpoint.service_is_ready() else [self.name]

    def send(self, request: Any = None, *, as_: str = "") -> Call:
        """Send a request without waiting; `as_` names it. Its answer is recorded when it comes, however late."""
        request = self.type.Request() if request is None else request
        call = Call(self._conversation.name("call", self.name, as_), self._conversation)
        self._conversation.log.append(ServiceCalled(call=call.name, service=self.name, request=request))
        call.request = Request(self.endpoint, request, call.on_answer)
        return call

    def call(self, request: Any = None, *, as_: str = "", timeout: float = ANSWER_TIMEOUT) -> bool:
        """Send a request and wait for its answer; return whether it came."""
        return self.send(request, as_=as_).wait(timeout)

    def call_at_once(self, requests: Sequence[Any]) -> bool:
        """Send several requests without waiting in between, then wait for all answers; return whether all came.

        Send at most 10 at once: a service's queue holds 10 requests, and a correct node would lose the rest.
        """
        answered = [call.wait() for call in [self.send(request) for request in requests]]
        return all(answered)
