"""A service called with every request and answer recorded."""

from __future__ import annotations

import threading
from typing import Any

from rclpy.node import Node
from rclpy.task import Future

from autograder.arena.received import is_too_large, size_of
from autograder.arena.recorder import Recorder
from ros_runtime.messages import from_dict, to_dict


class ServiceProbe:
    """Calls one service."""

    def __init__(
        self, node: Node, service_type: Any, name: str, recorder: Recorder, changed: threading.Condition
    ) -> None:
        self.name = name
        self._type = service_type
        self._recorder = recorder
        self._changed = changed
        self.answers: dict[str, dict[str, Any]] = {}
        self._client = node.create_client(service_type, name)

    def missing(self) -> list[str]:
        """Name the service unless it is matched."""
        return [] if self._client.service_is_ready() else [self.name]

    def send(self, call: str, request: dict[str, Any]) -> None:
        """Send a request under a name of the scenario's; the answer is recorded when it comes, however late."""
        message = from_dict(self._type.Request, request)
        self._recorder.record("service_called", call=call, service=self.name, request=request)
        self._client.call_async(message).add_done_callback(lambda future: self._on_answer(call, future))

    def _on_answer(self, call: str, future: Future) -> None:
        if future.cancelled():
            return
        response = future.result()
        if is_too_large("answer", call, size_of(response), self._recorder):
            answer = to_dict(self._type.Response())  # the scenario goes on as after any answer
        else:
            answer = to_dict(response)
            self._recorder.record("service_answered", call=call, response=answer)
        with self._changed:
            self.answers[call] = answer
            self._changed.notify_all()
