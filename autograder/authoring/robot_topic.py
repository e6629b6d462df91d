"""What a server that answers from a topic of the robot can know at a request: its last message there, or none."""

from __future__ import annotations

from typing import TypeVar

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.missing import unseen

E = TypeVar("E", bound=ev.Event)

# s a message may be on its way: 0.2 s of real time at scale 5, 0.1 s at scale 10. Scenarios wait a little longer.
DELIVERY = 1.0


def known_messages(call: Call, kind: type[E]) -> list[E] | None:
    """Return what may be the last message at a server that answered `call`, oldest first.

    It begins with the last message that had certainly arrived at the request, and ends with the last one before the
    answer: those in between may have been on their way.

    Args:
        call: the request and its answer.
        kind: the event that records a message.

    Returns:
        The messages; an empty list if certainly none had arrived; None if nobody can tell: what the robot published
        before the node was ready reaches it only if robot and node latch it.
    """
    ready = call.run.first(ev.NodeReady)
    published = [message for message in call.run.all(kind) if message.t <= call.answered.t]
    arrived = [
        index
        for index, message in enumerate(published)
        if ready and ready.t < message.t <= call.sent.t - DELIVERY
    ]
    if not published:
        return []
    return published[arrived[-1] :] if arrived else None


def last_messages(call: Call, kind: type[E], *, since: float = 0.0) -> list[E]:
    """Return what may be the last message, as `known_messages` does; one published after `since` (s) had to arrive."""
    known = known_messages(call, kind)
    if not known or known[0].t <= since:
        raise unseen(call.run, f"the robot published nothing in time for the request “{call.name}”")
    return known


def require_nothing_published(call: Call, kind: type[ev.Event], what: str) -> None:
    """Require that the robot published no message of a topic, `what` in words, before the answer."""
    if any(message.t <= call.answered.t for message in call.run.all(kind)):
        raise unseen(call.run, f"{what} was published too early")
