"""What a check judges: the record of an arena, with its calls, goals and requests by name.

Looking up something that is missing raises `Missing`, a failure with its reason, or, if the arena did not do its part,
`CannotBeJudged`.
"""

from __future__ import annotations

from functools import cached_property

from autograder.authoring.diagnosis.missing import Missing
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Call, Request
from autograder.authoring.evidence.goal import Cancel, Goal
from autograder.authoring.evidence.robot_record import RobotRecord
from autograder.authoring.evidence.scripted_goal import ScriptedGoal, scripted_goal


class Transcript(RobotRecord):
    """The record of an arena, with methods that look up calls, goals, requests and messages."""

    def mark(self, name: str) -> float:
        """Return the time (s) at which the scenario set a mark."""
        if mark := self.one(ev.Mark, "name", name):
            return mark.t
        raise Missing(self, expected=f"a scenario that reaches “{name}”", never="it never reached it")

    # -- actions ------------------------------------------------------------------------------------------------------

    def goal(self, name: str) -> Goal:
        """Return one goal, which must have been sent."""
        sent = self.one(ev.GoalSent, "goal", name)
        if sent is None:
            raise Missing(
                self,
                expected=f"a server that gets as far as the goal “{name}”",
                never=f"the goal “{name}” was never sent",
            )
        return Goal(
            name,
            sent,
            self.in_time(ev.GoalAnswered, "goal", name, of="goal"),
            [event for event in self.all(ev.FeedbackReceived) if event.goal == name],
            [event for event in self.all(ev.StatusSeen) if event.goal == name],
            [cancel for cancel in self.cancels if cancel.sent.goal == name],
            self.in_time(ev.ResultReceived, "goal", name, of="result"),
            self,
        )

    @cached_property
    def goals(self) -> list[Goal]:
        """Every goal that was sent, in order."""
        return [self.goal(name) for name in dict.fromkeys(sent.goal for sent in self.all(ev.GoalSent))]

    @cached_property
    def cancels(self) -> list[Cancel]:
        """Every cancel request, in order."""
        return [
            Cancel(event, self.in_time(ev.CancelAnswered, "cancel", name, of="cancel"), self)
            for name, event in self.by_name(ev.CancelSent, "cancel").items()
        ]

    # -- services -----------------------------------------------------------------------------------------------------

    @cached_property
    def calls(self) -> list[Call]:
        """Every service call, in order."""
        return [
            Call(name, event, self.in_time(ev.ServiceAnswered, "call", name, of="call"), self)
            for name, event in self.by_name(ev.ServiceCalled, "call").items()
        ]

    def call(self, name: str) -> Call:
        """Return the call that the scenario gave this name, which must have been made."""
        for call in self.calls:
            if call.name == name:
                return call
        raise Missing(
            self,
            expected=f"a server that gets as far as the request “{name}”",
            never=f"the request “{name}” was never sent",
        )

    # -- scripted services and actions --------------------------------------------------------------------------------

    def requests(self, service: str) -> list[Request]:
        """Return the requests to a scripted service, on any of its servers, in order."""
        return [
            Request(event, self.one(ev.ReplySent, "request", name))
            for name, event in self.by_name(ev.RequestReceived, "request").items()
            if event.service == service
        ]

    def scripted_goals(self, action: str) -> list[ScriptedGoal]:
        """Return the goals that the student's client sent to a scripted action, on any of its servers, in order."""
        received = self.by_name(ev.GoalReceived, "goal").values()
        return [scripted_goal(self, event) for event in received if event.action == action]

    # -- topics -------------------------------------------------------------------------------------------------------

    def received(self, topic: str) -> list[ev.MessageReceived]:
        """Return what the student's node published on a topic that the scenario subscribes to, in order."""
        return [event for event in self.all(ev.MessageReceived) if event.topic == topic]

    def published(self, topic: str) -> list[ev.MessagePublished]:
        """Return what the scenario published on a topic, in order."""
        return [event for event in self.all(ev.MessagePublished) if event.topic == topic]
