"""What all handles of a client share: the log, the reader of messages, the condition to stop waiting; and a request."""

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
from ros_runtime.record.event import Event
from ros_runtime.record.event_log import EventLog

DEFAULT_CLIENT = "client"  # the name of the client that cancels a goal, unless another one is given
LATE_SHARE = 0.8  # of the timeout; then the server's stacks are read, as a sleep may end with the timeout
UNKNOWN_GOAL = "unknown goal"  # for `Reading.admits`: a goal that this client has not sent


class Reading:
    """Deserializes what servers send; subclasses limit size and number."""

    def admits(self, what: str, of: str) -> bool:
        """Return whether to read one more event of a kind; `of` is its goal, call or service, or UNKNOWN_GOAL."""
        return True

    def is_too_large(self, what: str, id: str, message: Any) -> bool:
        """Return whether an answer exceeds the size limit and must not be read."""
        return False

    def unpack(self, what: str, id: str, data: bytes, message_type: Any) -> Any | None:
        """Return the message in serialized `data`; None if it exceeds the size limit."""
        return deserialize_message(data, message_type)


@dataclass
class Conversation:
    """The shared state of a client's handles.

    Attributes:
        log: records all requests, answers and messages; every wait is a wait for an event in it.
        reading: deserializes received messages and limits them.
        server_is_gone: returns whether the server has ended; if so, waits end early.
        server_stacks: returns where the server's threads are, for a late answer; None if that is recorded or unknown.
    """

    log: EventLog
    reading: Reading = field(default_factory=Reading)
    server_is_gone: Callable[[], bool] = lambda: False
    server_stacks: Callable[[], Event | None] = lambda: None
    _named: Counter[str] = field(default_factory=Counter)
    _naming: threading.Lock = field(default_factory=threading.Lock)

    def name(self, kind: str, of: str, wanted: str = "") -> str:
        """Return a unique name for a call, goal or cancel request: `wanted` if given, else `of` with a number."""
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
        """Wait for an answer; return whether it came. Record Unanswered if it does not come in `timeout` s.

        The wait ends early if the server is gone. Except for a result, the server's stacks are recorded, too.
        """
        started = time.monotonic()

        def wait_for(time_until: float) -> bool:
            self.log.wait_until(
                lambda: has_come() or self.server_is_gone(), started + time_until - time.monotonic()
            )
            return bool(has_come())

        if wait_for(timeout * LATE_SHARE):
            return True
        stacks = None if what == "result" else self.server_stacks()
        if wait_for(timeout):
            return True
        self.log.append(Unanswered(what=what, id=id, waited=time.monotonic() - started))
        if stacks:
            self.log.append(stacks)
        return False

    def was_too_large(self, what: str, id: str) -> bool:
        """Return whether an answer was received that exceeded the size limit."""
        return self.log.first(TooLarge, what=what, id=id) is not None


class Request:
    """A request that was sent; `on_answer` is called with the answer on the thread that spins the node."""

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
