"""What all handles of a client share: the log, the reader of messages, the condition to stop waiting, and a request."""

from __future__ import annotations

import threading
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

from rclpy.client import Client
from rclpy.serialization import deserialize_message
from rclpy.task import Future

from ros_runtime.record.client_events import TooLarge, Unanswered
from ros_runtime.record.event_log import EventLog

NOBODYS = "nobody's"  # stands for goals of other clients, in `Reading.admits`


class Reading:
    """Unpacks what servers send, without limits of size and number."""

    def admits(self, what: str, of: str) -> bool:
        """Return whether to read one more event of a kind; `of` names its goal, call or service, or is NOBODYS."""
        return True

    def is_too_large(self, what: str, id: str, message: Any) -> bool:
        """Return whether an answer is too large to be read."""
        return False

    def unpack(self, what: str, id: str, data: bytes, message_type: Any) -> Any | None:
        """Return the message in serialized `data`; None if it is not read."""
        return deserialize_message(data, message_type)


@dataclass
class Conversation:
    """The shared state of a client's handles.

    Attributes:
        log: records all requests, answers and messages; every wait is a wait for an event in it.
        reading: unpacks received messages and limits them.
        is_in_vain: returns True when the server is gone, so that waits end early.
    """

    log: EventLog
    reading: Reading = field(default_factory=Reading)
    is_in_vain: Callable[[], bool] = lambda: False
    _named: Counter[str] = field(default_factory=Counter)
    _naming: threading.Lock = field(default_factory=threading.Lock)

    def name(self, kind: str, of: str, wanted: str = "") -> str:
        """Return a name for a call, goal or cancel request: the one `wanted`, else `of` and a number."""
        with self._naming:
            self._named[f"{kind} {wanted or of}"] += 1
            number = self._named[f"{kind} {wanted or of}"]
        if wanted and number > 1:
            raise ValueError(f"there is already a {kind} named {wanted!r}")
        return wanted or f"{of} {number}"

    def wait(
        self,
        what: Literal["call", "goal", "cancel", "result"],
        id: str,
        has_come: Callable[[], Any],
        timeout: float,
    ) -> bool:
        """Return whether an answer came within `timeout` s; if not, or once `is_in_vain`, record Unanswered."""
        started = time.monotonic()
        self.log.wait_until(lambda: has_come() or self.is_in_vain(), timeout)
        if has_come():
            return True
        self.log.append(Unanswered(what=what, id=id, waited=time.monotonic() - started))
        return False

    def was_too_large(self, what: str, id: str) -> bool:
        """Return whether an answer was received that exceeded the size limit."""
        return self.log.first(TooLarge, what=what, id=id) is not None


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
