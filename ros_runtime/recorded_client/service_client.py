"""Calls of a service."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy.node import Node
from rclpy.task import Future

from ros_runtime.record.client_events import ServiceAnswered, ServiceCalled
from ros_runtime.recorded_client.conversation import Conversation

ANSWER_TIMEOUT = 5.0  # s


class Call:
    """A request on its way, or answered."""

    def __init__(self, name: str, conversation: Conversation) -> None:
        self.name = name
        self._conversation = conversation

    @property
    def response(self) -> Any | None:
        """The response; None before it comes."""
        answer = self._conversation.log.first(ServiceAnswered, call=self.name)
        return answer.response if answer else None

    def wait(self, timeout: float = ANSWER_TIMEOUT) -> bool:
        """Wait for the answer; return whether it came."""
        conversation = self._conversation
        return conversation.wait(
            "call",
            self.name,
            lambda: conversation.has_come(ServiceAnswered, "answer", call=self.name),
            timeout,
        )


class ServiceClient:
    """A client of one service; `name` is relative to the node's namespace."""

    def __init__(self, node: Node, name: str, service_type: Any, conversation: Conversation) -> None:
        self.name = name
        self._type = service_type
        self._conversation = conversation
        self._client = node.create_client(service_type, name)

    def unmatched(self) -> list[str]:
        """Name the service unless a server has been found."""
        return [] if self._client.service_is_ready() else [self.name]

    def send(self, request: Any = None, *, as_: str = "") -> Call:
        """Send a request without waiting; `as_` names it. Its answer is recorded when it comes, however late."""
        request = self._type.Request() if request is None else request
        call = Call(self._conversation.name("call", self.name, as_), self._conversation)
        self._conversation.log.append(ServiceCalled(call=call.name, service=self.name, request=request))
        self._client.call_async(request).add_done_callback(lambda future: self._on_answer(call.name, future))
        return call

    def call(self, request: Any = None, *, as_: str = "", timeout: float = ANSWER_TIMEOUT) -> bool:
        """Send a request and wait for its answer; return whether it came."""
        return self.send(request, as_=as_).wait(timeout)

    def call_at_once(self, requests: Sequence[Any], *, times: int = 1) -> None:
        """Send several requests without waiting in between, wait for the answers, and repeat that so many times.

        A service keeps its last 10 requests: more than that at once would be lost through no fault of the node. It ends
        if an answer does not come.
        """
        for _ in range(times):
            answered = [call.wait() for call in [self.send(request) for request in requests]]
            if not all(answered):
                return

    def _on_answer(self, call: str, future: Future) -> None:
        if future.cancelled():
            return
        response = future.result()
        if not self._conversation.reading.is_too_large("answer", call, response):
            self._conversation.log.append(ServiceAnswered(call=call, response=response))
