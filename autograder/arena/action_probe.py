"""An action's five endpoints used one by one, so that every request, answer and message is seen with its time.

rclpy's ActionClient drops feedback after the result and hides answers to cancel requests; here nothing is dropped
unsaid. Feedback and status come as bytes, because anybody may publish them, as much and as often as they like.
"""

from __future__ import annotations

import threading
import uuid
from typing import Any

from action_msgs.msg import GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from unique_identifier_msgs.msg import UUID

from autograder.arena.graph import Graph
from autograder.arena.received import is_too_large, size_of, unpack
from autograder.arena.recorder import NOBODYS, Recorder
from ros_runtime.messages import from_dict, to_dict

DEEP = QoSProfile(depth=1000)
LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
GOAL_ID = slice(4, 20)  # bytes of a serialized feedback message: behind what says how it is encoded


class ActionProbe:
    """Sends goals and cancels to one action and records all that comes back."""

    def __init__(
        self,
        node: Node,
        stranger: Node,
        graph: Graph,
        action_type: Any,
        name: str,
        recorder: Recorder,
        changed: threading.Condition,
    ) -> None:
        self.name = name
        self._graph = graph
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
            implementation.FeedbackMessage, f"{name}/_action/feedback", self._on_feedback, DEEP, raw=True
        )
        self._status = node.create_subscription(
            GoalStatusArray, f"{name}/_action/status", self._on_status, LATCHED, raw=True
        )

    def missing(self) -> list[str]:
        """Name the endpoints of the action that are not matched yet."""
        clients = (self._send_goal, self._get_result, *self._cancel_goal.values())
        topics = (self._feedback.topic_name, self._status.topic_name)
        services = {client.srv_name for client in clients if not client.service_is_ready()}
        return sorted(services) + [topic for topic in topics if self._graph.count_publishers(topic) == 0]

    def send_goal(self, goal: str, request: dict[str, Any]) -> None:
        """Send a goal under a name of the scenario's; its result is asked for as soon as it is accepted."""
        goal_id = uuid.uuid5(uuid.NAMESPACE_OID, goal).bytes
        self._goals[goal_id] = goal
        self.feedback_counts[goal] = 0
        message = self._type.Impl.SendGoalService.Request()
        message.goal_id = UUID(uuid=list(goal_id))
        message.goal = from_dict(self._type.Goal, request)
        self._recorder.record("goal_sent", goal=goal, action=self.name, request=request)
        future = self._send_goal.call_async(message)
        future.add_done_callback(lambda future: self._on_answer(goal, goal_id, future))

    def send_cancel(self, cancel: str, goal: str, by: str = "client") -> None:
        """Ask to cancel one goal, or with an empty `goal` every goal; `by` is 'client' or 'stranger' (another node)."""
        message = CancelGoal.Request()
        if goal:
            message.goal_info.goal_id.uuid = list(uuid.uuid5(uuid.NAMESPACE_OID, goal).bytes)
        self._recorder.record("cancel_sent", cancel=cancel, goal=goal, by=by)
        future = self._cancel_goal[by].call_async(message)
        future.add_done_callback(lambda future: self._on_cancel(cancel, future))

    def _on_answer(self, goal: str, goal_id: bytes, future: Future) -> None:
        if future.cancelled():
            return
        response = future.result()
        self._recorder.record("goal_answered", goal=goal, accepted=response.accepted)
        if response.accepted:
            request = self._type.Impl.GetResultService.Request()
            request.goal_id = UUID(uuid=list(goal_id))
            self._get_result.call_async(request).add_done_callback(
                lambda future: self._on_result(goal, future)
            )
        with self._changed:
            self.answers[goal] = response.accepted
            self._changed.notify_all()

    def _on_result(self, goal: str, future: Future) -> None:
        if future.cancelled():
            return
        response = future.result()
        if not is_too_large("result", goal, size_of(response), self._recorder):
            result = to_dict(response.result)
            self._recorder.record("result", goal=goal, status=response.status, result=result)
        with self._changed:
            self.results[goal] = response.status
            self._changed.notify_all()

    def _on_cancel(self, cancel: str, future: Future) -> None:
        if future.cancelled():
            return
        response = future.result()
        if not is_too_large("cancel answer", cancel, size_of(response), self._recorder):
            canceling = [self._name_of(bytes(info.goal_id.uuid)) for info in response.goals_canceling]
            self._recorder.record(
                "cancel_answered", cancel=cancel, return_code=response.return_code, canceling=canceling
            )
        with self._changed:
            self.cancel_answers[cancel] = response.return_code
            self._changed.notify_all()

    def _on_feedback(self, data: bytes) -> None:
        goal_id = data[GOAL_ID]
        goal = self._name_of(goal_id)
        if self._recorder.admits("feedback", self._goals.get(goal_id, NOBODYS)):
            message = unpack("feedback", goal, data, self._type.Impl.FeedbackMessage, self._recorder)
            if message is not None:
                self._recorder.record("feedback", goal=goal, feedback=to_dict(message.feedback))
        if goal in self.feedback_counts:
            with self._changed:
                self.feedback_counts[goal] += 1
                self._changed.notify_all()

    def _on_status(self, data: bytes) -> None:
        if not self._recorder.admits("status message", self.name):
            return
        message = unpack("status", "", data, GoalStatusArray, self._recorder)
        for status in message.status_list if message is not None else ():
            goal_id = bytes(status.goal_info.goal_id.uuid)
            goal = self._name_of(goal_id)
            if self._statuses.get(goal) == status.status:
                continue
            if self._recorder.admits("status", self._goals.get(goal_id, NOBODYS)):
                self._statuses[goal] = status.status
                self._recorder.record("status", goal=goal, status=status.status)

    def _name_of(self, goal_id: bytes) -> str:
        return self._goals.get(goal_id, f"unknown {goal_id.hex()[:8]}")
