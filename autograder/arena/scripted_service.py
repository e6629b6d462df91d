"""A scripted service, good or faulty, that a student's client has to deal with."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from rclpy.node import Node
from rclpy.task import Future

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.bounded_reading import BoundedReading
from autograder.arena.scripting import offer, pause, type_name


@dataclass(frozen=True)
class Reply:
    """The reply to one request: a response, None for an empty one, sent `after` s on the arena's clock."""

    response: Any = None
    after: float = 0.0


SILENCE = None
"""Stands for a Reply: the request is taken and never answered."""


class ScriptedService:
    """Offers one service. The first request gets the first of `replies`, and so on; the last one is repeated.

    `server` names it in the transcript, since two servers may offer the same service.
    """

    def __init__(
        self,
        node: Node,
        service_type: Any,
        name: str,
        replies: Sequence[Reply | None],
        server: str,
        log: ArenaLog,
        next_request: Callable[[], str],
    ) -> None:
        self.name = name
        self._node = node
        self._type = service_type
        self._replies = replies
        self._server = server
        self._log = log
        self._reading = BoundedReading(log)
        self._next_request = next_request
        self._service = offer(node, service_type, name, self._on_request)
        log.append(ev.ServiceOffered(service=name, server=server, type=type_name(service_type)))

    @property
    def requests(self) -> int:
        """The number of requests it has had."""
        return self._log.count(ev.RequestReceived, service=self.name, server=self._server)

    def reply_with(self, reply: Reply | None) -> None:
        """Answer all later requests with this reply."""
        self._replies = [reply]

    def withdraw(self) -> None:
        """Destroy the service, together with any request it is working on."""
        self._log.append(ev.ServiceWithdrawn(service=self.name, server=self._server))
        self._node.destroy_service(self._service)

    async def _on_request(self, request: Any, response: Any) -> Any:
        if not self._log.admits(ev.RequestReceived.kind, self.name):
            return response  # a flood of requests: answered at once, with an empty response
        name = self._next_request()
        reply = self._replies[min(self.requests, len(self._replies) - 1)]
        too_large = self._reading.is_too_large("request", name, request)
        message = self._type.Request() if too_large else request
        self._log.append(
            ev.RequestReceived(request=name, service=self.name, server=self._server, message=message)
        )
        if reply is SILENCE:
            await Future()  # never completed: no answer is sent
        else:
            await pause(self._node, reply.after)
            response = self._type.Response() if reply.response is None else reply.response
            self._log.append(ev.ReplySent(request=name, response=response))
        return response
