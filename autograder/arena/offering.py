"""What every stage can offer to the student's node: scripted services, actions and topics."""

from __future__ import annotations

from collections import defaultdict
from itertools import count
from typing import Any

from rclpy.node import Node

from autograder.arena.arena_log import ArenaLog
from autograder.arena.graph import Graph
from autograder.arena.scripted_action import GoalScript, ScriptedAction
from autograder.arena.scripted_service import Reply, ScriptedService
from autograder.arena.scripted_topic import ScriptedTopic
from autograder.arena.student import Student
from autograder.arena.waiting import Waiting


class Offering(Waiting):
    """Offers the scripted servers and publishers that the student's node needs; times are s on the arena's clock."""

    def __init__(self, node: Node, log: ArenaLog, student: Student) -> None:
        super().__init__(Graph(node, log), log)
        self._node = node
        self._student = student
        self._offered_services: list[ScriptedService] = []
        self._offered_actions: list[ScriptedAction] = []
        self._offered_topics: list[ScriptedTopic] = []
        self._numbers: defaultdict[str, count[int]] = defaultdict(lambda: count(1))

    def offer_service(self, name: str, service_type: Any, *replies: Reply | None) -> ScriptedService:
        """Offer a service that answers request n with `replies[n]`, later requests with the last one."""
        service = ScriptedService(
            self._node,
            service_type,
            name,
            replies,
            self._number("server"),
            self._log,
            lambda: self._number("request"),
        )
        self._offered_services.append(service)
        return service

    def offer_action(self, name: str, action_type: Any, *scripts: GoalScript) -> ScriptedAction:
        """Offer an action that treats goal n by `scripts[n]`, later goals by the last one."""
        action = ScriptedAction(
            self._node, action_type, name, scripts, self._number("server"), self._log, self._number
        )
        self._offered_actions.append(action)
        return action

    def offer_topic(self, name: str, message_type: Any, *, latched: bool = False) -> ScriptedTopic:
        """Publish a topic, with durability transient local when it is `latched`."""
        topic = ScriptedTopic(self._node, message_type, name, self._log, latched=latched)
        self._offered_topics.append(topic)
        return topic

    def wait_for_requests(self, service: ScriptedService, number: int, timeout: float) -> bool:
        """Wait for `number` requests to a scripted service; return False on timeout or at the program's end."""
        self.wait_until(lambda: service.requests >= number or self._student.has_exited(), timeout)
        return service.requests >= number

    def _offers_anything(self) -> bool:
        return bool(self._offered_services or self._offered_actions or self._offered_topics)

    def _was_asked(self) -> bool:
        """Return whether any request or goal was received."""
        services, actions = self._offered_services, self._offered_actions
        return any(service.requests for service in services) or any(action.goals for action in actions)

    def _is_known(self) -> bool:
        """Return whether every scripted service and action has a client, and every topic a subscription."""
        asked = [service.name for service in self._offered_services]
        asked += [f"{action.name}/_action/send_goal" for action in self._offered_actions]
        return all(map(self._graph.count_clients, asked)) and all(
            topic.subscriptions for topic in self._offered_topics
        )

    def _number(self, what: str) -> str:
        return f"{what} {next(self._numbers[what])}"
