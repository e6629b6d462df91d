"""A topic of the robot that a server subscribes to, and its last message when a request came."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.failure import Failure
from autograder.authoring.fields import same
from autograder.authoring.missing import unseen
from autograder.authoring.robot_record import RobotRecord

E = TypeVar("E", bound=ev.Event)

# s a message may be on its way: 0.2 s of real time at scale 5, 0.1 s at scale 10. Scenarios wait a little longer.
DELIVERY = 1.0

_OLDER = (
    "This is an older message. Replace the one you keep each time {topic} arrives, not only the first time."
)
_INVENTED = "Do not compute or invent values: answer with the whole message that arrived last on {topic}."


def last_messages(call: Call, kind: type[E], *, since: float | None = None) -> list[E]:
    """Return what may be 'the last message' at a server that answered `call`, oldest first.

    The messages begin with the last one that had certainly arrived at the request, and end with the last one before
    the answer: those in between may have been on their way. One published after `since` must have arrived for certain:
    it is the stimulus.

    Args:
        call: the request and its answer.
        kind: the event that records a message.
        since: s; None: when the first message was published that the node must have received.
    """
    run, answered = call.run, call.answered
    since = _first_received(run, kind) if since is None else since
    published = [message for message in run.all(kind) if message.t <= answered.t]
    arrived = [message for message in published if message.t <= call.sent.t - DELIVERY]
    if not arrived or arrived[-1].t <= since:
        raise unseen(run, f"the robot published nothing in time for the request “{call.name}”")
    return published[len(arrived) - 1 :]


def require_nothing_published(call: Call, kind: type[ev.Event], what: str) -> None:
    """Require that the robot published no message of a topic, `what` in words, before the answer."""
    if any(message.t <= call.answered.t for message in call.run.all(kind)):
        raise unseen(call.run, f"{what} was published too early")


@dataclass(frozen=True)
class RobotTopic:
    """A topic whose messages an answer repeats.

    Attributes:
        name: of the topic.
        kind: the event that records a message.
        fields: names of the fields to compare, which event and answer both have.
        shows: a format string that shows these fields to people.
    """

    name: str
    kind: type[ev.Event]
    fields: tuple[str, ...]
    shows: str

    def require_last_message(
        self,
        call: Call,
        answered: Any,
        *,
        since: float | None = None,
        advice: Callable[[Any, Any], str | None] = lambda answered, last: None,
    ) -> None:
        """Require that an answer repeats the last message there was when the request came.

        Args:
            call: the request and its answer.
            answered: the part of the response that repeats the message.
            since: s; a message must have been published after it. None: after the first that the node received.
            advice: returns what to do, given `answered` and the last message, if it recognises the mistake.
        """
        recent = last_messages(call, self.kind, since=since)
        if any(self._agree(answered, message) for message in recent):
            return
        old = any(
            self._agree(answered, message) for message in call.run.all(self.kind) if message.t < call.sent.t
        )
        general = (_OLDER if old else _INVENTED).format(topic=self.name)
        raise Failure(
            expected=f"the last {self.name}: {self._shown(recent[-1])}",
            observed=self._shown(answered),
            help=advice(answered, recent[-1]) or general,
            at=call.answered.t,
        )

    def _agree(self, answered: Any, message: ev.Event) -> bool:
        return all(same(getattr(answered, name), getattr(message, name)) for name in self.fields)

    def _shown(self, message: Any) -> str:
        return self.shows.format(**{name: getattr(message, name) for name in self.fields})


def _first_received(run: RobotRecord, kind: type[ev.Event]) -> float:
    """Return when (s) the first message was published that the node must have received."""
    ready = run.first(ev.NodeReady)
    return min((message.t for message in run.all(kind) if ready and message.t > ready.t), default=0.0)
