"""Logs the messages between notebook, servers and robot, from which a sequence diagram is drawn.

A call or a goal starts a new interaction, unless an earlier request is still pending. So a goal, its cancel and a
second goal that preempts it are one interaction, and the call in the next cell starts another.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from lab.client.messages import Message, Messages
from ros_runtime.record.client_events import (
    CancelAnswered,
    CancelSent,
    GoalAnswered,
    GoalSent,
    ResultReceived,
    ServiceAnswered,
    ServiceCalled,
    Unanswered,
)
from ros_runtime.record.event import Event
from ros_runtime.record.event_log import EventLog
from ros_runtime.recorded_client.conversation import UNKNOWN_GOAL, Conversation, Reading


class InteractionLog(EventLog):
    """The events of the current interaction; earlier events are dropped, because a session lasts for hours."""

    def __init__(self) -> None:
        super().__init__()
        self._pending: set[tuple[str, str]] = set()
        self._in_words = Messages()
        self._messages: list[Message] = []
        self._listeners: list[Callable[[Event], object]] = []

    @contextmanager
    def listening(self, listener: Callable[[Event], object]) -> Iterator[None]:
        """While the `with` block runs, call `listener` with each event, on the thread that appends the event."""
        with self._changed:
            self._listeners.append(listener)
        try:
            yield
        finally:
            with self._changed:
                self._listeners.remove(listener)

    def append(self, event: Event) -> None:
        """Add an event. Its arrows are made at once, because the student's code may change the message later."""
        with self._changed:
            if isinstance(event, ServiceCalled | GoalSent) and not self._pending:
                self.clear()
            self._note_pending(event)
            self._messages += self._in_words.of(event)
            super().append(event)
            for listener in self._listeners:
                listener(event)

    def messages(self) -> list[Message]:
        """Return the messages of the current interaction, in order of time."""
        with self._changed:
            return list(self._messages)

    def clear(self) -> None:
        """Remove all events; no request counts as pending after that."""
        with self._changed:
            super().clear()
            self._messages.clear()
            self._pending.clear()

    def _note_pending(self, event: Event) -> None:
        match event:
            case ServiceCalled(call=id):
                self._pending.add(("call", id))
            case GoalSent(goal=id):
                self._pending.add(("goal", id))
            case CancelSent(cancel=id):
                self._pending.add(("cancel", id))
            case ServiceAnswered(call=id) | Unanswered(what="call", id=id):
                self._pending.discard(("call", id))
            case GoalAnswered(goal=id, accepted=False) | ResultReceived(goal=id):
                self._pending.discard(("goal", id))
            case Unanswered(what="goal" | "result", id=id):
                self._pending.discard(("goal", id))
            case CancelAnswered(cancel=id) | Unanswered(what="cancel", id=id):
                self._pending.discard(("cancel", id))


class _OwnGoals(Reading):
    """Reads the feedback and status of this notebook's goals only, not of other clients' goals."""

    def admits(self, what: str, of: str) -> bool:
        return of != UNKNOWN_GOAL


log = InteractionLog()
conversation = Conversation(log, _OwnGoals())
