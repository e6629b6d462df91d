"""A service that the grader plays, well or badly, for a student's client to deal with."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.task import Future

from autograder.arena.received import is_too_large, size_of
from autograder.arena.recorder import Recorder
from ros_runtime.messages import from_dict, to_dict


@dataclass(frozen=True)
class Reply:
    """What one request gets: a response `after` s on the arena's clock."""

    response: dict[str, Any] = field(default_factory=dict)
    after: float = 0.0


SILENCE = None
"""In place of a Reply: the request is taken and never answered."""


class PlayedService:
    """Offers one service. The first request gets the first of `replies`, and so on; the last one is repeated.

    `server` names it in the transcript, where two offer the same service.
    """

    def __init__(
        self,
        node: Node,
        service_type: Any,
        name: str,
        replies: Sequence[Reply | None],
        server: str,
        recorder: Recorder,
        changed: threading.Condition,
        next_request: Callable[[], str],
    ) -> None:
        self.name = name
        self.requests = 0
        self._node = node
        self._type = service_type
        self._replies = replies
        self._server = server
        self._recorder = recorder
        self._changed = changed
        self._next_request = next_request
        self._service = node.create_service(
            service_type, name, self._on_request, callback_group=ReentrantCallbackGroup()
        )
        self._send = self._service.send_response
        self._service.send_response = self._send_if_anybody_waits  # type: ignore[method-assign]
        recorder.record("service_offered", service=name, server=server, type=_type_name(service_type))

    def withdraw(self) -> None:
        """Stop to exist, with whatever request is being worked on."""
        self._recorder.record("service_withdrawn", service=self.name, server=self._server)
        self._node.destroy_service(self._service)

    async def _on_request(self, request: Any, response: Any) -> Any:
        if not self._recorder.admits("request_received", self.name):
            return response  # a flood: what is left to wait for it is not worth remembering
        name = self._next_request()
        reply = self._replies[min(self.requests, len(self._replies) - 1)]
        too_large = is_too_large("request", name, size_of(request), self._recorder)
        self._recorder.record(
            "request_received",
            request=name,
            service=self.name,
            server=self._server,
            fields=to_dict(self._type.Request() if too_large else request),
        )
        with self._changed:
            self.requests += 1
            self._changed.notify_all()
        if reply is SILENCE:
            await Future()  # nobody ever completes it
        else:
            await self._pause(reply.after)
            self._recorder.record("reply_sent", request=name, response=reply.response)
            response = from_dict(self._type.Response, reply.response)
        return response

    def _send_if_anybody_waits(self, response: Any, header: Any) -> None:
        """Send a response; a client that has left, or a server withdrawn meanwhile, is no reason to stop serving."""
        with suppress(RuntimeError):  # what rclpy's own errors are
            self._send(response, header)

    async def _pause(self, duration: float) -> None:
        if duration <= 0:
            return
        over = Future()
        timer = self._node.create_timer(duration, lambda: over.set_result(None))
        try:
            await over
        finally:
            self._node.destroy_timer(timer)


def _type_name(service_type: Any) -> str:
    package = service_type.__module__.split(".")[0]
    return f"{package}/srv/{service_type.__name__}"
