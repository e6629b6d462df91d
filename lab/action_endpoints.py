"""The client's end of an action: its three services and two topics."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from action_msgs.msg import GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from lab import interaction_log
from lab.exchange import Exchange

STATUS_QOS = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)  # as every action has it


class Listener(Protocol):
    """A goal that receives what the server publishes about it."""

    def note_feedback(self, feedback: Any) -> None:
        """Take a feedback message of the action's type."""

    def note_status(self, status: int) -> None:
        """Take a status, a constant of action_msgs/GoalStatus."""


class ActionEndpoints:
    """One action's endpoints; `goals` receive its feedback and status messages, by goal id."""

    def __init__(self, node: Node, name: str, action_type: Any) -> None:
        self.name = name
        self.types = action_type.Impl
        self.goals: dict[bytes, Listener] = {}
        self._clients = {
            "send_goal": node.create_client(self.types.SendGoalService, f"{name}/_action/send_goal"),
            "get_result": node.create_client(self.types.GetResultService, f"{name}/_action/get_result"),
            "cancel_goal": node.create_client(CancelGoal, f"{name}/_action/cancel_goal"),
        }
        self._topics = [
            node.create_subscription(
                self.types.FeedbackMessage, f"{name}/_action/feedback", self._on_feedback, 10
            ),
            node.create_subscription(GoalStatusArray, f"{name}/_action/status", self._on_status, STATUS_QOS),
        ]
        self._node = node

    def are_matched(self) -> bool:
        """Whether a server has been found for every endpoint."""
        return all(client.service_is_ready() for client in self._clients.values()) and all(
            self._node.count_publishers(topic.topic_name) for topic in self._topics
        )

    def ask(
        self,
        service: str,
        request: Any,
        label: str,
        format_answer: Callable[[Any], str],
        on_answer: Callable[[Any], None] | None = None,
    ) -> Exchange:
        """Send a request to one of the three services."""
        return Exchange(
            self._clients[service],
            request,
            self._server,
            label,
            format_answer=format_answer,
            on_answer=on_answer,
            continues=service != "send_goal",
        )

    def record(self, label: str, *, repeats: bool = False) -> None:
        """Record in the interaction log what the server published."""
        interaction_log.record(self._server, interaction_log.NOTEBOOK, label, repeats=repeats)

    @property
    def _server(self) -> str:
        return f"{self.name} server"

    def _on_feedback(self, message: Any) -> None:
        goal = self.goals.get(bytes(bytearray(message.goal_id.uuid)))
        if goal:
            goal.note_feedback(message.feedback)

    def _on_status(self, message: GoalStatusArray) -> None:
        for status in message.status_list:
            goal = self.goals.get(bytes(bytearray(status.goal_info.goal_id.uuid)))
            if goal:
                goal.note_status(status.status)
