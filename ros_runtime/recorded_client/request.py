"""One request to a server, sent at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.client import Client
from rclpy.task import Future


class Request:
    """A request that was sent; `on_answer` gets the answer, on the thread that spins the node."""

    def __init__(self, client: Client, message: Any, on_answer: Callable[[Any], None]) -> None:
        self._client = client
        self._on_answer = on_answer
        self._future = client.call_async(message)
        self._future.add_done_callback(self._take)

    def give_up(self) -> None:
        """Ignore a later answer, and remove the request, which rclpy would keep until the client is destroyed."""
        self._client.remove_pending_request(self._future)

    def _take(self, future: Future) -> None:
        if not future.cancelled():
            self._on_answer(future.result())
