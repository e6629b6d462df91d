"""A goal, and a request to cancel it, as a scripted action received them from the student's client."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record


@dataclass(frozen=True)
class ScriptedCancel:
    """A request to cancel one goal, or every goal, and the reply (None: there was none)."""

    received: ev.CancelReceived
    reply: ev.CancelReplySent | None


@dataclass(frozen=True)
class ScriptedGoal:
    """One goal of the student's client, with all that the scripted action sent and received for it.

    Attributes:
        received: the goal request.
        reply: whether it was accepted; None: it was never answered.
        feedback: what was published for it, also before the reply.
        cancels: the requests to cancel it or every goal, from its arrival on.
        finished: how it ended; None: it never did.
        result_requested: when the client first asked for its result; None: never.
        result_sent: when the result was sent; None: never.
    """

    received: ev.GoalReceived
    reply: ev.GoalReplySent | None
    feedback: Sequence[ev.FeedbackSent]
    cancels: Sequence[ScriptedCancel]
    finished: ev.GoalFinished | None
    result_requested: ev.ResultRequested | None
    result_sent: ev.ResultSent | None

    @property
    def name(self) -> str:
        """Its name in the record: 'goal 1', 'goal 2', …, in the order of arrival."""
        return self.received.goal

    @property
    def message(self) -> Any:
        """The action's Goal."""
        return self.received.message

    @property
    def is_accepted(self) -> bool:
        """Whether the server accepted it."""
        return self.reply is not None and self.reply.accepted


def scripted_goal(run: Record, received: ev.GoalReceived) -> ScriptedGoal:
    """Return a goal that a scripted action received, with all events of it in the record."""
    name = received.goal
    return ScriptedGoal(
        received,
        run.one(ev.GoalReplySent, "goal", name),
        [event for event in run.all(ev.FeedbackSent) if event.goal == name],
        [
            ScriptedCancel(event, run.one(ev.CancelReplySent, "cancel", event.cancel))
            for event in run.all(ev.CancelReceived)
            if event.action == received.action and event.t >= received.t and event.goal in ("", name)
        ],
        run.one(ev.GoalFinished, "goal", name),
        run.one(ev.ResultRequested, "goal", name),
        run.one(ev.ResultSent, "goal", name),
    )
