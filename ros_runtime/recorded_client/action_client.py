"""Uses an action's five endpoints directly, so that every request, answer and message is recorded with its time.

rclpy's ActionClient drops feedback after the result and hides answers to cancel requests; here everything is recorded.
Feedback and status are read as bytes: any node may publish them, in any size and number.
"""

from __future__ import annotations

import uuid
from collections.abc import Callable, Mapping
from typing import Any
from weakref import WeakValueDictionary

from action_msgs.msg import GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from unique_identifier_msgs.msg import UUID

from ros_runtime.record.client_events import (
    CancelAnswered,
    CancelSent,
    FeedbackReceived,
    GoalAnswered,
    GoalSent,
    ResultReceived,
    StatusSeen,
)
from ros_runtime.record.event import Event
from ros_runtime.recorded_client.conversation import DEFAULT_CLIENT, UNKNOWN_GOAL, Conversation, Request
from ros_runtime.recorded_client.goal import Cancel, Goal

FEEDBACK_QOS = QoSProfile(depth=1000)
STATUS_QOS = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
GOAL_ID = slice(4, 20)  # byte range in a serialized feedback message, after the 4-byte encapsulation header


class ActionClient:
    """A client of one action; `name` is relative to the node's namespace.

    `others` maps names to further nodes that can send cancel requests for this client's goals.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        action_type: Any,
        conversation: Conversation,
        others: Mapping[str, Node] | None = None,
    ) -> None:
        self.name = name
        self.type = action_type
        self._conversation = conversation
        self._names: dict[bytes, str] = {}
        # Weak references: a goal with its feedback is freed when the caller drops it.
        self._goals: WeakValueDictionary[str, Goal] = WeakValueDictionary()
        self._statuses: dict[str, int] = {}
        types = action_type.Impl
        self._send_goal = node.create_client(types.SendGoalService, f"{name}/_action/send_goal")
        self._get_result = node.create_client(types.GetResultService, f"{name}/_action/get_result")
        self._cancel_goal = {
            by: owner.create_client(CancelGoal, f"{name}/_action/cancel_goal")
            for by, owner in {DEFAULT_CLIENT: node, **(others or {})}.items()
        }
        self._feedback = node.create_subscription(
            types.FeedbackMessage, f"{name}/_action/feedback", self._on_feedback, FEEDBACK_QOS, raw=True
        )
        self._status = node.create_subscription(
            GoalStatusArray, f"{name}/_action/status", self._on_status, STATUS_QOS, raw=True
        )

    def unmatched(self, count_publishers: Callable[[str], int]) -> list[str]:
        """Return the names of the action's endpoints for which no server has been discovered yet."""
        clients = (self._send_goal, self._get_result, *self._cancel_goal.values())
        topics = (self._feedback.topic_name, self._status.topic_name)
        services = {client.srv_name for client in clients if not client.service_is_ready()}
        return sorted(services) + [topic for topic in topics if count_publishers(topic) == 0]

    def send(self, goal: Any = None, *, as_: str = "") -> Goal:
        """Send a goal without waiting; `as_` names it. Its result is requested as soon as it is accepted."""
        goal = self.type.Goal() if goal is None else goal
        name = self._conversation.name("goal", self.name, as_)
        sent = Goal(name, uuid.uuid4().bytes, self._conversation, self._send_cancel)
        self._names[sent.id], self._goals[sent.name] = sent.name, sent
        self._conversation.log.append(GoalSent(goal=sent.name, action=self.name, request=goal))
        message = self.type.Impl.SendGoalService.Request(goal_id=UUID(uuid=list(sent.id)), goal=goal)
        sent.request = Request(self._send_goal, message, lambda answer: self._on_goal_answer(sent, answer))
        return sent

    def send_and_wait(self, goal: Any = None, *, as_: str = "") -> Goal:
        """Send a goal and wait until it is accepted or rejected."""
        sent = self.send(goal, as_=as_)
        sent.wait_for_answer()
        return sent

    def cancel_all(self, *, by: str = DEFAULT_CLIENT) -> Cancel:
        """Request to cancel every goal, without waiting; `by` is the name of the client that sends the request."""
        return self._send_cancel("", bytes(16), by)

    def _send_cancel(self, goal: str, goal_id: bytes, by: str) -> Cancel:
        request = CancelGoal.Request()
        request.goal_info.goal_id.uuid = list(goal_id)
        cancel = Cancel(self._conversation.name("cancel", "cancel"), self._conversation)
        self._conversation.log.append(CancelSent(cancel=cancel.name, goal=goal, by=by))
        cancel.request = Request(
            self._cancel_goal[by], request, lambda answer: self._on_cancel_answer(cancel, answer)
        )
        return cancel

    def _on_goal_answer(self, goal: Goal, answer: Any) -> None:
        if answer.accepted:
            request = self.type.Impl.GetResultService.Request(goal_id=UUID(uuid=list(goal.id)))
            Request(self._get_result, request, lambda answer: self._on_result(goal, answer))
        self._record(goal.name, GoalAnswered(goal=goal.name, accepted=answer.accepted))

    def _on_result(self, goal: Goal, answer: Any) -> None:
        if not self._conversation.reading.is_too_large("result", goal.name, answer):
            self._record(
                goal.name, ResultReceived(goal=goal.name, status=answer.status, result=answer.result)
            )

    def _on_cancel_answer(self, cancel: Cancel, answer: Any) -> None:
        if not self._conversation.reading.is_too_large("cancel answer", cancel.name, answer):
            canceling = [self._name_of(bytes(info.goal_id.uuid)) for info in answer.goals_canceling]
            cancel.answer = CancelAnswered(
                cancel=cancel.name, return_code=answer.return_code, canceling=canceling
            )
            self._conversation.log.append(cancel.answer)

    def _on_feedback(self, data: bytes) -> None:
        goal_id, reading = data[GOAL_ID], self._conversation.reading
        if not reading.admits(FeedbackReceived.kind, self._names.get(goal_id, UNKNOWN_GOAL)):
            return
        goal = self._name_of(goal_id)
        message = reading.unpack("feedback", goal, data, self.type.Impl.FeedbackMessage)
        if message is not None:
            self._record(goal, FeedbackReceived(goal=goal, feedback=message.feedback))

    def _on_status(self, data: bytes) -> None:
        reading = self._conversation.reading
        if not reading.admits("status message", self.name):
            return
        message = reading.unpack("status", "", data, GoalStatusArray)
        for status in message.status_list if message is not None else ():
            goal_id = bytes(status.goal_info.goal_id.uuid)
            goal = self._name_of(goal_id)
            if self._statuses.get(goal) == status.status:
                continue
            if reading.admits(StatusSeen.kind, self._names.get(goal_id, UNKNOWN_GOAL)):
                self._statuses[goal] = status.status
                self._record(goal, StatusSeen(goal=goal, status=status.status))

    def _record(self, name: str, event: Event) -> None:
        goal = self._goals.get(name)
        if goal is not None:
            goal.update(event)
        self._conversation.log.append(event)
        for listener in goal.listeners if goal is not None else ():
            listener()

    def _name_of(self, goal_id: bytes) -> str:
        return self._names.get(goal_id, f"unknown {goal_id.hex()[:8]}")
