"""Uses an action's five endpoints one by one, so that every request, answer and message is recorded with its time.

rclpy's ActionClient drops feedback after the result and hides answers to cancel requests; here everything is recorded.
Feedback and status are read as bytes, because any node may publish them, as much and as often as it likes.
"""

from __future__ import annotations

import uuid
from collections.abc import Callable, Mapping
from typing import Any

from action_msgs.msg import GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
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
from ros_runtime.recorded_client.conversation import NOBODYS, Conversation
from ros_runtime.recorded_client.goal import Cancel, Goal

DEEP = QoSProfile(depth=1000)
LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
GOAL_ID = slice(4, 20)  # bytes of a serialized feedback message: behind what says how it is encoded
ITSELF = "client"


class ActionClient:
    """A client of one action; `name` is relative to the node's namespace.

    `others` are nodes that may ask to cancel what this client has sent, by name.
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
        self._goals: dict[bytes, str] = {}
        self._statuses: dict[str, int] = {}
        types = action_type.Impl
        self._send_goal = node.create_client(types.SendGoalService, f"{name}/_action/send_goal")
        self._get_result = node.create_client(types.GetResultService, f"{name}/_action/get_result")
        self._cancel_goal = {
            by: owner.create_client(CancelGoal, f"{name}/_action/cancel_goal")
            for by, owner in {ITSELF: node, **(others or {})}.items()
        }
        self._feedback = node.create_subscription(
            types.FeedbackMessage, f"{name}/_action/feedback", self._on_feedback, DEEP, raw=True
        )
        self._status = node.create_subscription(
            GoalStatusArray, f"{name}/_action/status", self._on_status, LATCHED, raw=True
        )

    def unmatched(self, count_publishers: Callable[[str], int]) -> list[str]:
        """Name the endpoints of the action for which no server has been found yet."""
        clients = (self._send_goal, self._get_result, *self._cancel_goal.values())
        topics = (self._feedback.topic_name, self._status.topic_name)
        services = {client.srv_name for client in clients if not client.service_is_ready()}
        return sorted(services) + [topic for topic in topics if count_publishers(topic) == 0]

    def send(self, goal: Any = None, *, as_: str = "") -> Goal:
        """Send a goal without waiting; `as_` names it. Its result is asked for as soon as it is accepted."""
        goal = self.type.Goal() if goal is None else goal
        name, goal_id = self._conversation.name("goal", self.name, as_), uuid.uuid4().bytes
        self._goals[goal_id] = name
        self._conversation.log.append(GoalSent(goal=name, action=self.name, request=goal))
        request = self.type.Impl.SendGoalService.Request(goal_id=UUID(uuid=list(goal_id)), goal=goal)
        future = self._send_goal.call_async(request)
        future.add_done_callback(lambda future: self._on_goal_answer(name, goal_id, future))
        return Goal(name, goal_id, self, self._conversation)

    def send_and_wait(self, goal: Any = None, *, as_: str = "") -> Goal:
        """Send a goal and wait until it is accepted or rejected."""
        sent = self.send(goal, as_=as_)
        sent.wait_for_answer()
        return sent

    def cancel_all(self, *, by: str = ITSELF) -> Cancel:
        """Ask to cancel every goal, without waiting; `by` is the name of the client that asks."""
        return self.ask_to_cancel("", bytes(16), by)

    def ask_to_cancel(self, goal: str, goal_id: bytes, by: str) -> Cancel:
        """Ask to cancel a goal, without waiting."""
        request = CancelGoal.Request()
        request.goal_info.goal_id.uuid = list(goal_id)
        cancel = Cancel(self._conversation.name("cancel", "cancel"), self._conversation)
        self._conversation.log.append(CancelSent(cancel=cancel.name, goal=goal, by=by))
        future = self._cancel_goal[by].call_async(request)
        future.add_done_callback(lambda future: self._on_cancel_answer(cancel.name, future))
        return cancel

    def _on_goal_answer(self, goal: str, goal_id: bytes, future: Future) -> None:
        if future.cancelled():
            return
        accepted = future.result().accepted
        if accepted:
            request = self.type.Impl.GetResultService.Request(goal_id=UUID(uuid=list(goal_id)))
            self._get_result.call_async(request).add_done_callback(
                lambda future: self._on_result(goal, future)
            )
        self._conversation.log.append(GoalAnswered(goal=goal, accepted=accepted))

    def _on_result(self, goal: str, future: Future) -> None:
        if future.cancelled():
            return
        response = future.result()
        if not self._conversation.reading.is_too_large("result", goal, response):
            self._conversation.log.append(
                ResultReceived(goal=goal, status=response.status, result=response.result)
            )

    def _on_cancel_answer(self, cancel: str, future: Future) -> None:
        if future.cancelled():
            return
        response = future.result()
        if not self._conversation.reading.is_too_large("cancel answer", cancel, response):
            canceling = [self._name_of(bytes(info.goal_id.uuid)) for info in response.goals_canceling]
            self._conversation.log.append(
                CancelAnswered(cancel=cancel, return_code=response.return_code, canceling=canceling)
            )

    def _on_feedback(self, data: bytes) -> None:
        goal_id, reading = data[GOAL_ID], self._conversation.reading
        if not reading.admits(FeedbackReceived.kind, self._goals.get(goal_id, NOBODYS)):
            return
        goal = self._name_of(goal_id)
        message = reading.unpack("feedback", goal, data, self.type.Impl.FeedbackMessage)
        if message is not None:
            self._conversation.log.append(FeedbackReceived(goal=goal, feedback=message.feedback))

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
            if reading.admits(StatusSeen.kind, self._goals.get(goal_id, NOBODYS)):
                self._statuses[goal] = status.status
                self._conversation.log.append(StatusSeen(goal=goal, status=status.status))

    def _name_of(self, goal_id: bytes) -> str:
        return self._goals.get(goal_id, f"unknown {goal_id.hex()[:8]}")
