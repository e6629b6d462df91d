"""A topic of the robot that a server listens to: what its last message was when a request came."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.failure import Failure
from autograder.authoring.fields import same
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript

E = TypeVar("E", bound=ev.Event)

# s a message may be on its way: 0.2 s of wall time at scale 5, 0.1 s at scale 10. Scenarios wait a little longer.
DELIVERY = 1.0

_OLDER = (
    "This is an older message. Replace the one you keep each time {topic} arrives, not only the first time."
)
_INVENTED = "Do not compute or invent values: answer with the whole message that arrived last on {topic}."


def last_messages(call: Call, kind: type[E], *, since: float | None = None) -> list[E]:
    """Return what may be 'the last message' at a server that answered `call`, oldest first.

    That is the newest at the request, what it may not have taken the place of yet, since it was still on its way, and
    what came before the answer. A message sent after `since` (s) must have had the time to arrive: it is the stimulus.
    Without `since` it is one after the first that the node heard, which it may keep.
    """
    run, answered = call.run, call.answered
    since = _first_heard(run, kind) if since is None else since
    published = [message for message in run.all(kind) if message.t <= answered.t]
    arrived = [message for message in published if message.t <= call.sent.t - DELIVERY]
    if not arrived or arrived[-1].t <= since:
        raise unseen(run, f"the robot published nothing in time for the request “{call.name}”")
    return published[len(arrived) - 1 :]


def require_nothing_published(call: Call, kind: type[ev.Event], what: str) -> None:
    """The robot had published no message of a topic, `what` in words, until the answer."""
    if any(message.t <= call.answered.t for message in call.run.all(kind)):
        raise unseen(call.run, f"{what} was published too early")


@dataclass(frozen=True)
class RobotTopic:
    """A topic whose messages an answer repeats.

    `kind` is the event that records a message; `fields` are those that are compared, which the event and the answer
    both have. `shows` is a format of them for people.
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
        """The part `answered` of the response is the last message there was when the request came.

        A message must have been published after `since` (s; None: after the first that the node heard). `advice` says
        what to do where it knows the mistake from what was answered and the last message.
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


def _first_heard(run: Transcript, kind: type[ev.Event]) -> float:
    """When (s) the first message was published that the node must have heard."""
    ready = run.first(ev.NodeReady)
    return min((message.t for message in run.all(kind) if ready and message.t > ready.t), default=0.0)
