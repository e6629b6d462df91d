"""An action's five endpoints used one by one, so that every request, answer and message is seen with its time.

rclpy's ActionClient drops feedback after the result and hides answers to cancel requests; here nothing is dropped.
"""

from __future__ import annotations

import threading
import uuid
from typing import Any

from action_msgs.msg import GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from unique_identifier_msgs.msg import UUID

from autograder.arena.recorder import Recorder
from ros_runtime.messages import from_dict, to_dict

DEEP = QoSProfile(depth=1000)
LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class ActionProbe:
    """Sends goals and cancels to one action and records all that comes back."""

    def __init__(
        self,
        node: Node,
        stranger: Node,
        action_type: Any,
        name: str,
        recorder: Recorder,
        changed: threading.Condition,
    ) -> None:
        self.name = name
        self._type = action_type
        self._recorder = recorder
        self._changed = changed
        self._goals: dict[bytes, str] = {}
        self._statuses: dict[str, int] = {}
        self.answers: dict[str, bool] = {}
        self.results: dict[str, int] = {}
        self.feedback_counts: dict[str, int] = {}
        self.cancel_answers: dict[str, int] = {}
        implementation = action_type.Impl
        self._send_goal = node.create_client(implementation.SendGoalService, f"{name}/_action/send_goal")
        self._get_result = node.create_client(implementation.GetResultService, f"{name}/_action/get_result")
        self._cancel_goal = {
            by: owner.create_client(CancelGoal, f"{name}/_action/cancel_goal")
            for by, owner in (("client", node), ("stranger", stranger))
        }
        self._feedback = node.create_subscription(
            implementation.FeedbackMessage, f"{name}/_action/feedback", self._on_feedback, DEEP
        )
        self._status = node.create_subscription(
            GoalStatusArray, f"{name}/_action/status", self._on_status, LATCHED
        )
        self._node = node

    def missing(self) -> list[str]:
        """Name the endpoints of the action that are not matched yet."""
        clients = (self._send_goal, self._get_result, *self._cancel_goal.values())
        topics = (self._feedback.topic_name, self._status.topic_name)
        services = {client.srv_name for client in clients if not client.service_is_ready()}
        return sorted(services) + [topic for topic in topics if self._node.count_publishers(topic) == 0]

    def send_goal(self, goal: str, request: dict[str, Any]) -> None:
        """Send a goal under a name of the scenario's; its result is asked for as soon as it is accepted."""
        goal_id = uuid.uuid5(uuid.NAMESPACE_OID, goal).bytes
        self._goals[goal_id] = goal
        self.feedback_counts[goal] = 0
        message = self._type.Impl.SendGoalService.Request()
        message.goal_id = UUID(uuid=list(goal_id))
        message.goal = from_dict(self._type.Goal, request)
        self._recorder.record("goal_sent", goal=goal, action=self.name, request=request)
        self._send_goal.call_async(message).add_done_callback(
            lambda future: self._on_answer(goal, goal_id, future.result())
        )

    def send_cancel(self, cancel: str, goal: str, by: str = "client") -> None:
        """Ask to cancel one goal, or with an empty `goal` every goal; `by` is 'client' or 'stranger' (another node)."""
        message = CancelGoal.Request()
        if goal:
            message.goal_info.goal_id.uuid = list(uuid.uuid5(uuid.NAMESPACE_OID, goal).bytes)
        self._recorder.record("cancel_sent", cancel=cancel, goal=goal, by=by)
        future = self._cancel_goal[by].call_async(message)
        future.add_done_callback(lambda future: self._on_cancel(cancel, future.result()))

    def _on_answer(self, goal: str, goal_id: bytes, response: Any) -> None:
        self._recorder.record("goal_answered", goal=goal, accepted=response.accepted)
        if response.accepted:
            request = self._type.Impl.GetResultService.Request()
            request.goal_id = UUID(uuid=list(goal_id))
            future = self._get_result.call_async(request)
            future.add_done_callback(lambda future: self._on_result(goal, future.result()))
        with self._changed:
            self.answers[goal] = response.accepted
            self._changed.notify_all()

    def _on_result(self, goal: str, response: Any) -> None:
        self._recorder.record("result", goal=goal, status=response.status, result=to_dict(response.result))
        with self._changed:
            self.results[goal] = response.status
            self._changed.notify_all()

    def _on_cancel(self, cancel: str, response: Any) -> None:
        canceling = [self._name_of(info.goal_id) for info in response.goals_canceling]
        self._recorder.record(
            "cancel_answered", cancel=cancel, return_code=response.return_code, canceling=canceling
        )
        with self._changed:
            self.cancel_answers[cancel] = response.return_code
            self._changed.notify_all()

    def _on_feedback(self, message: Any) -> None:
        goal = self._name_of(message.goal_id)
        self._recorder.record("feedback", goal=goal, feedback=to_dict(message.feedback))
        with self._changed:
            self.feedback_counts[goal] = self.feedback_counts.get(goal, 0) + 1
            self._changed.notify_all()

    def _on_status(self, message: GoalStatusArray) -> None:
        for status in message.status_list:
            goal = self._name_of(status.goal_info.goal_id)
            if self._statuses.get(goal) != status.status:
                self._statuses[goal] = status.status
                self._recorder.record("status", goal=goal, status=status.status)

    def _name_of(self, goal_id: UUID) -> str:
        identifier = bytes(bytearray(goal_id.uuid))
        return self._goals.get(identifier, f"unknown {identifier.hex()[:8]}")
